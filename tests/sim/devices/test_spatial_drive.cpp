// SPDX-License-Identifier: BSD-3-Clause
// Models and links that have a velocity along their own axes.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "bubblesim/error.hpp"
#include "bubblesim/spatial_drive.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_spatial_drive {
namespace {

constexpr double kStep = 0.001;

std::shared_ptr<SpatialDrive> drive_of(World& world, const std::string& path) {
  const ObjectId object = world.tree().find(path);
  auto drive = std::make_shared<SpatialDrive>(world, object);
  world.devices().add(drive, world.tree().outermost_model_of(object));
  return drive;
}

TEST(SpatialDrive, MovesAModelOnAHelix) {
  // v along the body's x, w about its z, and a climb: a circle of radius v / w.
  World world(scene({model("Robot", link("link"), Pose(1, 2, 3, 0, 0, M_PI / 2))}, Vector3::Zero()), 0);
  const ObjectId robot = world.tree().find("/Robot");
  const auto drive = drive_of(world, "/Robot");
  const Vector3 centre = world.pose(robot) * Vector3(0, 0.5, 0);
  drive->set_velocity({{0.5, 0, 0.1}, {0, 0, 1}});
  world.advance(2, kStep);
  const Pose pose = world.pose(robot);
  EXPECT_NEAR(std::hypot(pose.position.x() - centre.x(), pose.position.y() - centre.y()), 0.5, 1e-3);
  EXPECT_NEAR(pose.position.z(), 3.2, 1e-6);
  EXPECT_NEAR(std::remainder(to_rpy(pose.orientation).z() - M_PI / 2 - 2, 2 * M_PI), 0, 1e-3);
}

TEST(SpatialDrive, LeavesGravityOneSubstep) {
  World world(scene({model("Robot", link("link"), Pose())}, {0, 0, -10}), 0);
  const ObjectId robot = world.tree().find("/Robot");
  drive_of(world, "/Robot")->set_velocity({});
  world.advance(1, kStep);
  EXPECT_NEAR(world.pose(robot).position.z(), -10 * kStep, 1e-6);  // at g h, from 0 in each substep
}

TEST(SpatialDrive, KeepsTheMotionOfPartsToEachOther) {
  // A wheel that spins freely, beside the axis about which its robot turns.
  ModelDescription robot = model("Robot", link("body"), Pose());
  robot.links.push_back(link("wheel"));
  robot.links.back().pose.position = {0, 0.3, 0};
  JointDescription axle;
  axle.name = "axle";
  axle.type = "revolute";
  axle.parent = "body";
  axle.child = "wheel";
  axle.pose.position = {0, 0.3, 0};
  axle.axes.emplace_back();
  axle.axes[0].direction = {0, 1, 0};
  robot.joints.push_back(axle);
  World world(scene({robot}, Vector3::Zero()), 0);
  const ObjectId wheel = world.tree().find("/Robot/wheel");
  world.set_velocity(wheel, {{}, {0, 5, 0}});
  const auto drive = drive_of(world, "/Robot");
  drive->set_velocity({{1, 0, 0}, {}});
  world.advance(0.5, kStep);
  EXPECT_NEAR(world.velocity(wheel).angular.y(), 5, 1e-3);
  EXPECT_NEAR(world.velocity(wheel).linear.x(), 1, 1e-3);
  EXPECT_NEAR(world.pose(wheel).position.x(), 0.5, 1e-3);
}

TEST(SpatialDrive, MovesALinkAlone) {
  ModelDescription pair = model("Pair", link("a"), Pose());
  pair.links.push_back(link("b"));
  pair.links.back().pose.position = {5, 0, 0};
  World world(scene({pair}, Vector3::Zero()), 0);
  drive_of(world, "/Pair/b")->set_velocity({{0, 1, 0}, {}});
  world.advance(1, kStep);
  EXPECT_NEAR(world.pose(world.tree().find("/Pair/b")).position.y(), 1, 1e-6);
  EXPECT_NEAR(world.pose(world.tree().find("/Pair/a")).position.y(), 0, 1e-9);
}

TEST(SpatialDrive, DoesNothingWithoutACommandAndAfterAReset) {
  World world(scene({model("Robot", link("link"), Pose())}, Vector3::Zero()), 0);
  const ObjectId robot = world.tree().find("/Robot");
  const auto drive = drive_of(world, "/Robot");
  drive->set_velocity({{1, 0, 0}, {}});
  world.advance(1, kStep);
  world.reset();
  world.set_velocity(robot, {{0, 2, 0}, {}});
  world.advance(1, kStep);
  EXPECT_NEAR((world.velocity(robot).linear - Vector3(0, 2, 0)).norm(), 0, 1e-9);
}

TEST(SpatialDrive, RefusesWhatItCannotMove) {
  ModelDescription floor = model("Floor", link("link"), Pose());
  floor.is_static = true;
  World world(scene({floor, model("Robot", link("link"), Pose())}, Vector3::Zero()), 0);
  EXPECT_THROW(SpatialDrive(world, world.tree().find("/Floor")), WrongObject);
  SpatialDrive drive(world, world.tree().find("/Robot"));
  EXPECT_THROW(drive.set_velocity({{std::nan(""), 0, 0}, {}}), InvalidInput);
  EXPECT_THROW(drive.set_velocity({{}, {0, 2e6, 0}}), InvalidInput);
}

}  // namespace
}  // namespace bubblesim::test::test_spatial_drive
