// SPDX-License-Identifier: BSD-3-Clause
// Links at fixed joints become one link, and links without mass.
#include <gtest/gtest.h>

#include "urdf_texts.hpp"

namespace bubblesim::test::test_urdf_lumping {
namespace {

using Names = std::vector<std::string>;

std::string collision(const std::string& name = "") {
  return "<collision" + (name.empty() ? "" : " name='" + name + "'") + ">" + kUnitBox + "</collision>";
}

Names names_of_collisions(const ModelDescription& model, std::size_t link = 0) {
  Names names;
  for (const CollisionDescription& each : model.links.at(link).collisions) names.push_back(each.name);
  return names;
}

TEST(Lumping, AddsMassesAndMovesTheCentreOfMass) {
  const std::string heavy = "<inertial><origin xyz='0 1 0'/><mass value='3'/>" + kUnitInertia + "</inertial>";
  const ModelDescription model =
      read(robot(link_text("a") + link_text("b", heavy) + joint_text("j", "fixed", "a", "b", "<origin xyz='0 0 4'/>")));
  ASSERT_EQ(model.links.size(), 1U);
  EXPECT_TRUE(model.joints.empty());
  EXPECT_EQ(model.links[0].mass, 4);
  EXPECT_TRUE(model.links[0].centre_of_mass.isApprox(Vector3(0, 0.75, 3)));
}

TEST(Lumping, CombinesInertiasByTheParallelAxisTheorem) {
  // Two points of 1 and 3 kg, 2 m apart along x: m1 m2 / (m1 + m2) d^2 = 3 kg m^2 about y and z.
  const std::string heavy = "<inertial><mass value='3'/>" + kUnitInertia + "</inertial>";
  const ModelDescription model =
      read(robot(link_text("a") + link_text("b", heavy) + joint_text("j", "fixed", "a", "b", "<origin xyz='2 0 0'/>")));
  EXPECT_TRUE(model.links.at(0).inertia_diagonal.isApprox(Vector3(2, 5, 5)));
  EXPECT_TRUE(model.links[0].inertia_products.isZero(1e-12));
}

TEST(Lumping, TurnsInertias) {
  // A turn by 45 degrees about z: xx and yy become their mean, xy half of their difference.
  const std::string flat =
      "<inertial><mass value='1'/><inertia ixx='3' ixy='0' ixz='0' iyy='1' iyz='0' izz='4'/></inertial>";
  const ModelDescription model =
      read(robot(link_text("a", "") + link_text("b", flat) +
                 joint_text("j", "fixed", "a", "b", "<origin rpy='0 0 0.7853981633974483'/>")));
  EXPECT_TRUE(model.links.at(0).inertia_diagonal.isApprox(Vector3(2, 2, 4)));
  EXPECT_TRUE(model.links[0].inertia_products.isApprox(Vector3(1, 0, 0), 1e-9));
}

TEST(Lumping, KeepsTheInertiaOfARigidBodyWhateverItIsDividedInto) {
  // A rod of 1 kg and 2 m along x, about its centre: m l^2 / 12; the same as two halves.
  const auto rod = [](double mass, double length, const std::string& x) {
    const std::string moment = std::to_string(mass * length * length / 12);
    return "<inertial><origin xyz='" + x + " 0 0'/><mass value='" + std::to_string(mass) +
           "'/><inertia ixx='0.001' ixy='0' ixz='0' iyy='" + moment + "' iyz='0' izz='" + moment + "'/></inertial>";
  };
  const ModelDescription whole = read(robot(link_text("a", rod(1, 2, "0"))));
  const ModelDescription halves = read(robot(link_text("a", rod(0.5, 1, "-0.5")) + link_text("b", rod(0.5, 1, "0")) +
                                             joint_text("j", "fixed", "a", "b", "<origin xyz='0.5 0 0'/>")));
  EXPECT_NEAR(halves.links.at(0).inertia_diagonal.y(), whole.links.at(0).inertia_diagonal.y(), 1e-5);
  EXPECT_TRUE(halves.links[0].centre_of_mass.isZero(1e-12));
}

TEST(Lumping, MovesTheJointsOfLumpedLinks) {
  const ModelDescription model =
      read(robot(link_text("a") + link_text("b") + link_text("c") + joint_text("j", "fixed", "a", "b") +
                 joint_text("k", "continuous", "b", "c")));
  EXPECT_EQ(names_of_links(model), (Names{"a", "c"}));
  EXPECT_EQ(model.joints.at(0).parent, "a");
  EXPECT_EQ(model.joints[0].pose.position, Vector3(0, 0, 2));
}

TEST(Lumping, NamesShapesAsGazebo) {
  const ModelDescription model = read(
      robot(link_text("base", kUnitInertial + collision() + collision("x") + collision("base_2")) +
            link_text("sonar_link", collision() + collision("y")) + joint_text("j", "fixed", "base", "sonar_link")));
  EXPECT_EQ(names_of_collisions(model),
            (Names{"base_collision", "base_fixed_joint_lump__x_collision_1", "base_2_collision_2",
                   "base_fixed_joint_lump__sonar_link_collision_3", "base_fixed_joint_lump__y_collision_4"}));
  EXPECT_EQ(model.links[0].collisions[3].pose.position, Vector3(0, 0, 1));
}

TEST(Lumping, NamesALinkThatStartsAsTheBodyByItself) {
  const ModelDescription model = read(robot(link_text("base", kUnitInertial) + link_text("base_inertia", collision()) +
                                            joint_text("j", "fixed", "base", "base_inertia")));
  EXPECT_EQ(names_of_collisions(model), Names{"base_inertia_collision"});
}

TEST(Lumping, IsInTheOrderOfTheNamesOfJoints) {
  const ModelDescription model = read(robot(link_text("a") + link_text("b", collision()) + link_text("c", collision()) +
                                            link_text("d", collision()) + joint_text("2", "fixed", "a", "b") +
                                            joint_text("1", "fixed", "a", "c") + joint_text("0", "fixed", "b", "d")));
  EXPECT_EQ(names_of_collisions(model), (Names{"a_fixed_joint_lump__c_collision", "a_fixed_joint_lump__b_collision_1",
                                               "a_fixed_joint_lump__d_collision_2"}));
}

TEST(Lumping, CanBePrevented) {
  const std::string arm = link_text("a") + link_text("b") + joint_text("j", "fixed", "a", "b");
  const ModelDescription fixed = read(robot(arm + gazebo("j", "<preserveFixedJoint>true</preserveFixedJoint>")));
  EXPECT_EQ(fixed.links.size(), 2U);
  EXPECT_EQ(fixed.joints.at(0).type, "fixed");
  const ModelDescription turning =
      read(robot(arm + gazebo("j", "<disableFixedJointLumping>true</disableFixedJointLumping>")));
  EXPECT_EQ(turning.joints.at(0).type, "revolute");
  EXPECT_EQ(turning.joints[0].axes.at(0).lower, 0);
  EXPECT_EQ(turning.joints[0].axes[0].upper, 0);
  EXPECT_EQ(read(robot(arm + gazebo("j", "<preserveFixedJoint>false</preserveFixedJoint>"))).links.size(), 1U);
}

TEST(MasslessLink, IsLumpedWhateverIsAsked) {
  const ModelDescription model = read(robot(link_text("a") + link_text("b", "") + joint_text("j", "fixed", "a", "b") +
                                            gazebo("j", "<preserveFixedJoint>true</preserveFixedJoint>")));
  EXPECT_EQ(names_of_links(model), Names{"a"});
}

TEST(MasslessLink, ThatIsLumpedKeepsWhatMovesOnIt) {
  const ModelDescription model =
      read(robot(link_text("a") + link_text("b", "") + link_text("wheel") + joint_text("j", "fixed", "a", "b") +
                 joint_text("k", "continuous", "b", "wheel")));
  EXPECT_EQ(names_of_links(model), (Names{"a", "wheel"}));
}

TEST(MasslessLink, ThatWouldMoveIsLeftOutWithAllBelowIt) {
  const std::string text = robot(link_text("a") + link_text("b", "") + link_text("c") + link_text("d") + "\n" +
                                 joint_text("j", "continuous", "a", "b") + joint_text("k", "continuous", "b", "c") +
                                 joint_text("l", "continuous", "c", "d"));
  EXPECT_EQ(names_of_links(read(text)), Names{"a"});
  EXPECT_EQ(warnings_about(text),
            "r.urdf:2: /r/j: is ignored with all links below it: 'b' has no mass; add an <inertial>\n");
}

TEST(MasslessLink, AtTheRootIsFixedToTheWorld) {
  const std::string text = robot("\n" + link_text("a", "") + link_text("b") + joint_text("j", "continuous", "a", "b"));
  const ModelDescription model = read(text);
  EXPECT_EQ(model.joints.at(0).name, "world_holds_a");
  EXPECT_EQ(model.joints[0].parent, "world");
  EXPECT_GT(model.links.at(0).mass, 0);
  EXPECT_EQ(warnings_about(text),
            "r.urdf:2: /r/a: has no mass: it is fixed to the world; add an <inertial> if it shall move\n");
}

TEST(MasslessLink, AtTheRootGetsTheMassThatIsFixedToIt) {
  const ModelDescription model =
      read(robot(link_text("foot", "") + link_text("base") + joint_text("j", "fixed", "foot", "base")));
  EXPECT_EQ(names_of_links(model), Names{"foot"});
  EXPECT_EQ(model.links[0].mass, 1);
  EXPECT_TRUE(model.joints.empty());
}

TEST(MasslessLink, AtTheWorldHoldsWhatMovesOnIt) {
  const ModelDescription model =
      read(robot(link_text("world", "") + link_text("a", "") + link_text("b") + joint_text("j", "fixed", "world", "a") +
                 joint_text("k", "continuous", "a", "b")));
  EXPECT_EQ(names_of_links(model), (Names{"a", "b"}));
}

TEST(World, CannotBeAChild) {
  const std::string text =
      robot(link_text("a") + link_text("world", "") + "\n" + joint_text("j", "fixed", "a", "world"));
  EXPECT_EQ(warnings_about(text),
            "r.urdf:2: /r/j: is ignored: the world cannot be the child of a joint; make it the parent\n");
}

}  // namespace
}  // namespace bubblesim::test::test_urdf_lumping
