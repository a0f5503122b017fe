// SPDX-License-Identifier: BSD-3-Clause
// Reading <gripper>.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "bubblesim/scene_loader.hpp"
#include "scene_files.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_grippers {
namespace {

constexpr const char* kLinks = "<link name='palm'/><link name='left'/><link name='right'/>";

std::string gripper(const std::string& palm, const std::string& check = "") {
  return "<gripper name='hand'>" + check +
         "<gripper_link>left</gripper_link><gripper_link>right</gripper_link><palm_link>" + palm +
         "</palm_link></gripper>";
}

ModelDescription loaded(const std::string& models, std::vector<Problem>* warnings = nullptr) {
  const TemporaryFile file("gripper.sdf", in_world(models));
  return read_scene(file.path(), {}, warnings).models.at(0);
}

TEST(Gripper, HasItsLinksAndSteps) {
  const std::string check =
      "<grasp_check><detach_steps>30</detach_steps><attach_steps>10</attach_steps><min_contact_count>3</"
      "min_contact_count></grasp_check>";
  const GripperDescription read =
      loaded("<model name='m'>" + (kLinks + gripper(" palm ", check)) + "</model>").grippers.at(0);
  EXPECT_EQ(read.name, "hand");
  EXPECT_EQ(read.palm, "palm");
  EXPECT_EQ(read.fingers, (std::vector<std::string>{"left", "right"}));
  EXPECT_EQ(read.min_contacts, 3);
  EXPECT_EQ(read.attach_steps, 10);
  EXPECT_EQ(read.detach_steps, 30);
}

TEST(Gripper, HasSdformatsDefaults) {
  const GripperDescription read = loaded("<model name='m'>" + (kLinks + gripper("palm")) + "</model>").grippers.at(0);
  EXPECT_EQ(read.min_contacts, 2);
  EXPECT_EQ(read.attach_steps, 20);
  EXPECT_EQ(read.detach_steps, 40);
}

TEST(Gripper, OfANestedModelNamesItsLinks) {
  const ModelDescription outer =
      loaded("<model name='m'><model name='arm'>" + (kLinks + gripper("palm")) + "</model></model>");
  EXPECT_EQ(outer.grippers.at(0).palm, "arm::palm");
  EXPECT_EQ(outer.grippers.at(0).fingers.at(1), "arm::right");
}

TEST(Gripper, WithoutItsLinksIsLeftOut) {
  std::vector<Problem> warnings;
  EXPECT_TRUE(loaded("<model name='m'>" + (kLinks + gripper("plam")) + "</model>", &warnings).grippers.empty());
  EXPECT_NE(
      lines_of(warnings).find("the gripper 'hand' is ignored: 'plam' is not a link of this model; did you mean palm?"),
      std::string::npos)
      << lines_of(warnings);
}

TEST(Gripper, OfAUrdfNamesTheLinkThatALumpedOneIsAPartOf) {
  const std::string inertial =
      "<inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>";
  const auto link = [&](const std::string& name) { return "<link name='" + name + "'>" + inertial + "</link>"; };
  const auto joint = [](const std::string& type, const std::string& parent, const std::string& child) {
    return "<joint name='to_" + child + "' type='" + type + "'><parent link='" + parent + "'/><child link='" + child +
           "'/><axis xyz='0 0 1'/><limit lower='0' upper='1' effort='1' velocity='1'/></joint>";
  };
  const TemporaryFile file("robot.urdf", "<robot name='r'>" + link("base") + link("palm") + link("left") +
                                             link("right") + joint("fixed", "base", "palm") +
                                             joint("prismatic", "base", "left") + joint("prismatic", "base", "right") +
                                             "<gazebo>" + gripper("palm") + "</gazebo></robot>");
  const SceneDescription scene = read_scene(file.path());
  ASSERT_EQ(scene.models.back().grippers.size(), 1U);
  EXPECT_EQ(scene.models.back().grippers[0].palm, "base");
}

}  // namespace
}  // namespace bubblesim::test::test_grippers
