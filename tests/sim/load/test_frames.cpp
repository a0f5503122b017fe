// SPDX-License-Identifier: BSD-3-Clause
// Poses by the frame semantics of SDFormat (sdformat.org, "Pose Frame Semantics"); expected poses are worked out by
// hand.
#include <gtest/gtest.h>

#include "bubblesim/error.hpp"
#include "bubblesim/scene_loader.hpp"
#include "scene_files.hpp"

namespace bubblesim::test::test_frames {
namespace {

ModelDescription model_of(const std::string& parts, const std::string& attributes = "",
                          std::vector<Problem>* warnings = nullptr) {
  return load_model("<sdf version='1.9'><model name='m'" + attributes + ">" + parts + "</model></sdf>", "/", warnings);
}

std::string problem_of(const std::string& parts, const std::string& version = "1.9") {
  try {
    load_model("<sdf version='" + version + "'>\n<model name='m'>\n" + parts + "</model></sdf>", "/");
  } catch (const SceneError& error) {
    return error.what();
  }
  return "it loads";
}

std::string link(const std::string& name, const std::string& pose, const std::string& base = "") {
  return "<link name='" + name + "'><pose" + (base.empty() ? "" : " relative_to='" + base + "'") + ">" + pose +
         "</pose></link>";
}

void expect_pose(const Pose& found, const Pose& expected) {
  EXPECT_LT((found.position - expected.position).norm(), 1e-12)
      << found.position.transpose() << " and not " << expected.position.transpose();
  EXPECT_LT(found.orientation.angularDistance(expected.orientation), 1e-7);
}

constexpr double kQuarter = M_PI / 2;
const std::string kQuarterTurn = " 0 0 1.5707963267948966";

TEST(Frame, OfALinkIsRelativeToAnyOther) {
  const ModelDescription model =
      model_of(link("c", "1 0 0 0 0 0", "b") + link("b", "1 0 0" + kQuarterTurn, "a") + link("a", "0 0 3 0 0 0"));
  expect_pose(model.links[1].pose, {1, 0, 3, 0, 0, kQuarter});
  expect_pose(model.links[0].pose, {1, 1, 3, 0, 0, kQuarter});
}

TEST(Frame, AttachedToALinkStandsInIt) {
  const ModelDescription model =
      model_of(link("a", "0 0 3" + kQuarterTurn) + "<frame name='f' attached_to='a'><pose>1 0 0 0 0 0</pose></frame>" +
               link("b", "1 0 0 0 0 0", "f"));
  expect_pose(model.links[1].pose, {0, 2, 3, 0, 0, kQuarter});
}

TEST(Frame, OfAJointIsThatOfItsChild) {
  const std::string joint = "<joint name='j' type='fixed'><parent>a</parent><child>b</child>";
  ModelDescription model = model_of(link("a", "0 0 0 0 0 0") + link("b", "1 0 0" + kQuarterTurn) + joint +
                                    "<pose>1 0 0 0 0 0</pose></joint>");
  expect_pose(model.joints[0].pose, {1, 1, 0, 0, 0, kQuarter});
  model = model_of(link("a", "0 0 5 0 0 0") + link("b", "1 0 0" + kQuarterTurn) + joint +
                   "<pose relative_to='a'>1 0 0 0 0 0</pose></joint>");
  expect_pose(model.joints[0].pose, {1, 0, 5, 0, 0, 0});
}

TEST(Frame, OfAJointPlacesALink) {
  const ModelDescription model = model_of(link("a", "0 0 1 0 0 0") + link("b", "0 0 2 0 0 0") +
                                          "<joint name='j' type='fixed'><parent>a</parent><child>b</child></joint>" +
                                          link("c", "1 0 0 0 0 0", "j"));
  expect_pose(model.links[2].pose, {1, 0, 2, 0, 0, 0});
}

TEST(Frame, OfAnAxisMayBeAnother) {
  const auto direction = [](const std::string& frame) {
    return model_of(link("a", "0 0 0" + kQuarterTurn) + link("b", "0 0 0 0 0 0") +
                    "<joint name='j' type='revolute'><parent>a</parent><child>b</child><axis><xyz expressed_in='" +
                    frame + "'>1 0 0</xyz></axis></joint>")
        .joints.at(0)
        .axes.at(0)
        .direction;
  };
  EXPECT_LT((direction("") - Vector3(1, 0, 0)).norm(), 1e-12);
  EXPECT_LT((direction("a") - Vector3(0, 1, 0)).norm(), 1e-12);
  EXPECT_LT((direction("__model__") - Vector3(1, 0, 0)).norm(), 1e-12);
}

TEST(Frame, OfAShapeIsThatOfItsLink) {
  const ModelDescription model =
      model_of("<link name='a'><pose>0 0 1" + kQuarterTurn +
               "</pose><collision name='c'><pose relative_to='b'>0 0 0 0 0 0</pose><geometry><sphere/></geometry>"
               "</collision></link>" +
               link("b", "0 2 1 0 0 0"));
  expect_pose(model.links[0].collisions.at(0).pose, {2, 0, 0, 0, 0, -kQuarter});
}

TEST(Frame, InANestedModelHasItsNameBefore) {
  const std::string inner = "<model name='inner'><pose>0 0 1" + kQuarterTurn + "</pose>" + link("l", "1 0 0 0 0 0") +
                            "<frame name='f'><pose>0 0 7 0 0 0</pose></frame></model>";
  const ModelDescription model =
      model_of(link("a", "1 0 0 0 0 0", "inner::l") + link("b", "0 0 0 0 0 0", "inner::f") + inner);
  expect_pose(model.links[0].pose, {0, 2, 1, 0, 0, kQuarter});
  expect_pose(model.links[1].pose, {0, 0, 8, 0, 0, kQuarter});
}

TEST(Frame, ThatIsPlacedMovesItsModel) {
  const ModelDescription model =
      model_of(link("a", "0 0 0 0 0 0") + "<model name='inner' placement_frame='top'><pose>0 0 5 0 0 0</pose>" +
               link("l", "0 0 0 0 0 0") + "<frame name='top'><pose>0 0 2 0 0 0</pose></frame></model>");
  expect_pose(model.nested.at(0).pose, {0, 0, 3, 0, 0, 0});
}

TEST(Frame, OfAJointsEndLeadsToItsLink) {
  const ModelDescription model = model_of(
      link("a", "0 0 0 0 0 0") + "<frame name='f' attached_to='a'/><model name='inner'>" + link("l", "0 0 0 0 0 0") +
      "<frame name='g'/></model>" + "<joint name='j' type='fixed'><parent>f</parent><child>inner::g</child></joint>");
  EXPECT_EQ(model.joints.at(0).parent, "a");
  EXPECT_EQ(model.joints.at(0).child, "inner::l");
}

TEST(Frame, ThatDoesNotExistIsAProblemOfItsLine) {
  EXPECT_EQ(problem_of(link("base", "0 0 0 0 0 0") + "\n" + link("a", "0 0 0 0 0 0", "bass")),
            "<data-string>:4: /m/a: is relative to 'bass', which is not a link, joint, frame or model there; did you "
            "mean base?");
}

TEST(Frame, ThatDoesNotExistIsIgnoredWhereItWasBefore17) {
  std::vector<Problem> warnings;
  const ModelDescription model = load_model(
      "<sdf version='1.6'><model name='m'><link name='a'><pose frame='x::y'>1 2 3 0 0 0</pose></link></model></sdf>",
      "/", &warnings);
  expect_pose(model.links[0].pose, {1, 2, 3, 0, 0, 0});
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].message.find("is relative to 'x::y'"), std::string::npos);
}

TEST(Frame, ThatIsRelativeToItselfIsAProblem) {
  EXPECT_NE(problem_of(link("a", "0 0 0 0 0 0", "b") + link("b", "0 0 0 0 0 0", "a")).find("is relative to itself"),
            std::string::npos);
  EXPECT_NE(problem_of(link("a", "0 0 0 0 0 0", "a")).find("is relative to itself"), std::string::npos);
}

TEST(Frame, AtTheEndOfALongChainIsFound) {
  std::string links = link("l0", "0 0 0 0 0 0");
  constexpr int kLinks = 20'000;
  for (int i = kLinks - 1; i > 0; --i) {
    links += "<frame name='l" + std::to_string(i) + "'><pose relative_to='l" + std::to_string(i - 1) +
             "'>0 0 1 0 0 0</pose></frame>";
  }
  const ModelDescription model = model_of(links + link("end", "0 0 0 0 0 0", "l" + std::to_string(kLinks - 1)));
  EXPECT_NEAR(model.links.at(1).pose.position.z(), kLinks - 1, 1e-6);
}

TEST(Pose, MayBeInDegreesOrAQuaternion) {
  const auto orientation = [](const std::string& attribute, const std::string& numbers) {
    return model_of("<link name='l'><pose " + attribute + ">0 0 0 " + numbers + "</pose></link>")
        .links[0]
        .pose.orientation;
  };
  const Quaternion quarter = from_rpy(0, 0, kQuarter);
  EXPECT_LT(orientation("degrees='true'", "0 0 90").angularDistance(quarter), 1e-7);
  EXPECT_LT(orientation("rotation_format='quat_xyzw'", "0 0 2 2").angularDistance(quarter), 1e-7);
}

}  // namespace
}  // namespace bubblesim::test::test_frames
