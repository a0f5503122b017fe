// SPDX-License-Identifier: BSD-3-Clause
// A gripper above a slippery box: two fingers close along y, the palm is lifted along z.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include "bubblesim/error.hpp"
#include "bubblesim/grasp.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_grasp {
namespace {

constexpr double kStep = 0.005;

LinkDescription finger(const std::string& name, double y) {
  LinkDescription made = link_with(Box{{0.1, 0.02, 0.2}}, 0.01);
  made.name = name;
  made.pose = at(0, y, 0.1);
  made.mass = 0.2;
  made.inertia_diagonal = {1e-3, 1e-3, 1e-3};
  return made;
}

ModelDescription gripper() {
  ModelDescription made = model("Gripper", link("palm", {0, 0, 0.4}));
  made.links.push_back(finger("left", 0.1));
  made.links.push_back(finger("right", -0.1));
  made.joints = {joint("prismatic", {axis(Vector3::UnitZ(), MotorMode::kPosition)}, {}, "world", "palm"),
                 joint("prismatic", {axis(-Vector3::UnitY(), MotorMode::kVelocity)}, {}, "palm", "left"),
                 joint("prismatic", {axis(Vector3::UnitY(), MotorMode::kVelocity)}, {}, "palm", "right")};
  made.joints[0].name = "lift";
  made.joints[1].name = "close_left";
  made.joints[2].name = "close_right";
  for (int i : {1, 2}) made.joints[static_cast<std::size_t>(i)].axes[0].max_force = 20;
  return made;
}

struct Gripping : testing::Test {
  Gripping() {
    ModelDescription box = model("Box", link_with(Box{{0.1, 0.1, 0.1}}, 0.01), at(0, 0, 0.05));
    box.links[0].mass = 0.5;
    box.links[0].inertia_diagonal = {1e-3, 1e-3, 1e-3};
    world = std::make_unique<World>(scene({floor(), gripper(), box}), 0);
  }

  ObjectId find(const std::string& path) const { return world->tree().find(path); }

  void add(GraspDescription description) {
    description.palm = find("/Gripper/palm");
    description.fingers = {find("/Gripper/left"), find("/Gripper/right")};
    grasp = std::make_shared<Grasp>(*world, description);
    world->devices().add(grasp, find("/Gripper"));
  }

  /// m/s, for a time in s.
  void close(double speed, double time) {
    for (const char* name : {"/Gripper/close_left", "/Gripper/close_right"}) {
      world->joints().set_target_velocity(find(name), speed);
    }
    world->advance(time, kStep);
  }

  void lift(double height) {
    world->joints().set_target_position(find("/Gripper/lift"), height);
    world->advance(1, kStep);
  }

  double height() const { return world->pose(find("/Box")).position.z(); }

  std::unique_ptr<World> world;
  std::shared_ptr<Grasp> grasp;
};

TEST_F(Gripping, LosesASlipperyBoxWithoutAttachingIt) {
  close(0.1, 1);
  lift(0.3);
  EXPECT_LT(height(), 0.1);
}

TEST_F(Gripping, LiftsWhatBothFingersPressAndDropsItWhenTheyOpen) {
  add({});
  close(0.1, 1);
  EXPECT_EQ(grasp->attached(), find("/Box/link"));
  lift(0.3);
  EXPECT_NEAR(height(), 0.35, 0.01);
  close(-0.1, 0.1);
  EXPECT_NE(grasp->attached(), kNoObject) << "40 updates have not passed";
  close(-0.1, 0.3);
  EXPECT_EQ(grasp->attached(), kNoObject);
  close(0, 1);
  EXPECT_NEAR(height(), 0.05, 0.01);
}

TEST_F(Gripping, WaitsForTheGivenNumberOfUpdates) {
  GraspDescription slow;
  slow.attach_updates = 300;  // 1.5 s
  add(slow);
  close(0.1, 1.5);  // 0.4 s of it until they touch the box
  EXPECT_EQ(grasp->attached(), kNoObject);
  close(0.1, 0.7);
  EXPECT_EQ(grasp->attached(), find("/Box/link"));
}

TEST_F(Gripping, DoesNotAttachWhatOneFingerPresses) {
  add({});
  world->joints().set_target_velocity(find("/Gripper/close_left"), 0.1);
  world->advance(0.8, kStep);
  EXPECT_EQ(grasp->attached(), kNoObject);
}

TEST_F(Gripping, AsksForForcesAtAnAngle) {
  GraspDescription opposing;
  opposing.min_angle = 2.5;  // rad; the fingers push at pi
  add(opposing);
  close(0.1, 1);
  EXPECT_EQ(grasp->attached(), find("/Box/link"));
}

TEST_F(Gripping, WithSlackHoldsOnUntilAFingerHasMovedAway) {
  GraspDescription with_slack;
  with_slack.slack = 0.02;
  with_slack.detach_updates = 4;
  add(with_slack);
  close(0.1, 1);
  close(-0.05, 0.2);  // about 1 cm
  EXPECT_NE(grasp->attached(), kNoObject);
  close(-0.05, 0.4);
  EXPECT_EQ(grasp->attached(), kNoObject);
}

TEST_F(Gripping, BeginsAnewAfterAReset) {
  add({});
  close(0.1, 1);
  ASSERT_NE(grasp->attached(), kNoObject);
  world->reset();
  EXPECT_EQ(grasp->attached(), kNoObject);
  EXPECT_TRUE(world->attachments().all().empty());
  close(0.1, 1);
  EXPECT_NE(grasp->attached(), kNoObject);
}

TEST_F(Gripping, LetsGoOfWhatIsRemoved) {
  add({});
  close(0.1, 1);
  world->models().remove(find("/Box"));
  world->advance(0.1, kStep);
  EXPECT_EQ(grasp->attached(), kNoObject);
}

TEST_F(Gripping, RefusesWhatIsNoGripper) {
  const ObjectId palm = find("/Gripper/palm");
  const auto made = [&](GraspDescription description) { Grasp(*world, std::move(description)); };
  GraspDescription none;
  none.palm = palm;
  EXPECT_THROW(made(none), InvalidInput);
  GraspDescription of_model = none;
  of_model.fingers = {find("/Gripper")};
  EXPECT_THROW(made(of_model), WrongObject);
  GraspDescription bad = none;
  bad.fingers = {palm};
  bad.min_angle = 4;
  EXPECT_THROW(made(bad), InvalidInput);
  bad.min_angle.reset();
  bad.slack = -1;
  EXPECT_THROW(made(bad), InvalidInput);
}

}  // namespace
}  // namespace bubblesim::test::test_grasp
