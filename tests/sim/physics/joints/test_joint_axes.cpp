// SPDX-License-Identifier: BSD-3-Clause
// Degrees of freedom of the joint kinds, and their positions.
#include <gtest/gtest.h>

#include "bubblesim/error.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_joint_axes {
namespace {

constexpr double kStep = 0.005;

/// A world of two links and a joint, with helper functions.
struct Jointed {
  explicit Jointed(JointDescription description) : world(jointed(std::move(description)), 0) {}

  Pose arm_in_base() const { return world.pose(base).inverse() * world.pose(arm); }

  World world;
  ObjectId base = world.tree().find("/base");
  ObjectId arm = world.tree().find("/arm");
  ObjectId joint = world.tree().find("/joint");
};

TEST(JointPosition, IsZeroAsBuiltEvenWhenTheLinksAreTurned) {
  for (const char* type : {"revolute", "continuous", "prismatic"}) {
    ModelDescription robot = model("Robot", link("base"), Pose(1, 2, 3, 0.3, -0.2, 1));
    robot.links.push_back(link("arm", {0.5, 0, 0}));
    robot.links[1].pose.orientation = from_rpy(0.7, 0.1, -2);
    robot.joints.push_back(joint(type, {axis({0, 0.6, 0.8})}, {0.2, 0, 0}));
    const World world(scene({robot}, Vector3::Zero()), 0);
    EXPECT_NEAR(world.joints().position(world.tree().find("/joint")), 0, 1e-12) << type;
  }
}

class TurningJoint : public ::testing::TestWithParam<std::tuple<const char*, const char*, Vector3>> {};

TEST_P(TurningJoint, PositiveVelocityTurnsTheChildAboutPlusAxis) {
  const auto& [type, parent, direction] = GetParam();
  Jointed pair(joint(type, {axis(direction, MotorMode::kVelocity)}, {}, parent));
  pair.world.joints().set_target_velocity(pair.joint, 0.5);
  pair.world.advance(2, kStep);
  const bool fixed_parent = std::string(parent) == "world";
  const Pose from = fixed_parent ? Pose() : pair.world.pose(pair.base);
  const double turned = turn_about(direction, from, pair.world.pose(pair.arm));
  EXPECT_NEAR(turned, 1, 0.01);
  EXPECT_NEAR(pair.world.joints().position(pair.joint), turned, 1e-6);
  EXPECT_NEAR(pair.world.joints().velocity(pair.joint), 0.5, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, TurningJoint,
    ::testing::Combine(::testing::Values("revolute", "continuous"), ::testing::Values("base", "world"),
                       ::testing::Values(Vector3::UnitX(), Vector3::UnitY(), Vector3::UnitZ(), Vector3(0, 0.6, -0.8))));

class SlidingJoint : public ::testing::TestWithParam<std::tuple<const char*, Vector3>> {};

TEST_P(SlidingJoint, PositiveVelocityMovesTheChildAlongPlusAxis) {
  const auto& [parent, direction] = GetParam();
  Jointed pair(joint("prismatic", {axis(direction, MotorMode::kVelocity)}, {}, parent));
  pair.world.joints().set_target_velocity(pair.joint, 0.5);
  pair.world.advance(2, kStep);
  const bool fixed_parent = std::string(parent) == "world";
  const Pose from = fixed_parent ? Pose() : pair.world.pose(pair.base);
  const Vector3 moved = (from.inverse() * pair.world.pose(pair.arm)).position;
  EXPECT_LT((moved - direction).norm(), 0.01);
  EXPECT_NEAR(pair.world.joints().position(pair.joint), moved.dot(direction), 1e-6);
  EXPECT_NEAR(pair.world.joints().velocity(pair.joint), 0.5, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Parents, SlidingJoint,
                         ::testing::Combine(::testing::Values("base", "world"),
                                            ::testing::Values(Vector3::UnitX(), Vector3::UnitZ(),
                                                              Vector3(0, 0.6, -0.8))));

TEST(JointFrame, TurnsItsAxisAlong) {
  JointDescription turned = joint("revolute", {axis(Vector3::UnitZ(), MotorMode::kVelocity)});
  turned.pose.orientation = from_rpy(-M_PI / 2, 0, 0);  // z of the joint is y of the model
  Jointed pair(turned);
  pair.world.joints().set_target_velocity(pair.joint, 0.5);
  pair.world.advance(1, kStep);
  EXPECT_NEAR(turn_about(Vector3::UnitY(), pair.world.pose(pair.base), pair.world.pose(pair.arm)), 0.5, 0.01);
}

JointDescription steered_wheel(MotorMode steering, MotorMode rolling) {
  return joint("revolute2", {axis(Vector3::UnitZ(), steering), axis(Vector3::UnitY(), rolling)});
}

TEST(Revolute2, FirstAxisTurnsTheChildPositively) {
  Jointed pair(steered_wheel(MotorMode::kVelocity, MotorMode::kVelocity));
  pair.world.joints().set_target_velocity(pair.joint, 0.5, 0);
  pair.world.advance(2, kStep);
  const double turned = turn_about(Vector3::UnitZ(), pair.world.pose(pair.base), pair.world.pose(pair.arm));
  EXPECT_NEAR(turned, 1, 0.01);
  EXPECT_NEAR(pair.world.joints().position(pair.joint, 0), turned, 1e-4);
  EXPECT_NEAR(pair.world.joints().velocity(pair.joint, 0), 0.5, 1e-4);
  EXPECT_NEAR(pair.world.joints().position(pair.joint, 1), 0, 1e-4);
}

TEST(Revolute2, SecondAxisTurnsTheChildPositively) {
  Jointed pair(steered_wheel(MotorMode::kVelocity, MotorMode::kVelocity));
  pair.world.joints().set_target_velocity(pair.joint, 0.5, 1);
  pair.world.advance(2, kStep);
  const double turned = turn_about(Vector3::UnitY(), pair.world.pose(pair.base), pair.world.pose(pair.arm));
  EXPECT_NEAR(turned, 1, 0.01);
  EXPECT_NEAR(pair.world.joints().position(pair.joint, 1), turned, 1e-4);
  EXPECT_NEAR(pair.world.joints().velocity(pair.joint, 1), 0.5, 1e-4);
  EXPECT_NEAR(pair.world.joints().position(pair.joint, 0), 0, 1e-4);
}

TEST(Revolute2, SteersByPositionWhileItRolls) {
  Jointed pair(steered_wheel(MotorMode::kPosition, MotorMode::kVelocity));
  pair.world.joints().set_target_position(pair.joint, 0.4, 0);
  pair.world.joints().set_target_velocity(pair.joint, 2, 1);
  pair.world.advance(3, kStep);
  EXPECT_NEAR(pair.world.joints().position(pair.joint, 0), 0.4, 1e-3);
  EXPECT_NEAR(pair.world.joints().velocity(pair.joint, 1), 2, 1e-3);
  const Vector3 axle = pair.arm_in_base().orientation * Vector3::UnitY();
  EXPECT_NEAR(std::atan2(-axle.x(), axle.y()), 0.4, 1e-3) << "the axle has the angle of the steering joint";
}

TEST(Revolute2, EffortTurnsEachAxisPositively) {
  for (const int axis : {0, 1}) {
    Jointed pair(steered_wheel(MotorMode::kEffort, MotorMode::kEffort));
    pair.world.joints().set_target_effort(pair.joint, 0.5, axis);
    pair.world.advance(0.1, kStep);
    // Two bodies of 1 kg m^2 turn against each other.
    EXPECT_NEAR(pair.world.joints().velocity(pair.joint, axis), 0.5 * 0.1 * 2, 1e-6);
    EXPECT_NEAR(pair.world.joints().velocity(pair.joint, 1 - axis), 0, 1e-6);
    EXPECT_NEAR(pair.world.joints().motor_effort(pair.joint, axis), 0.5, 1e-9);
    EXPECT_EQ(pair.world.joints().motor_effort(pair.joint, 1 - axis), 0);
  }
}

TEST(Revolute2, LimitsOfTheFirstAxisHoldOnTheirOwnSide) {
  JointDescription described = steered_wheel(MotorMode::kVelocity, MotorMode::kNone);
  described.axes[0].lower = -0.3;
  described.axes[0].upper = 0.8;
  described.axes[0].max_force = 5;
  Jointed pair(described);
  pair.world.joints().set_target_velocity(pair.joint, 1, 0);
  pair.world.advance(3, kStep);
  EXPECT_NEAR(pair.world.joints().position(pair.joint, 0), 0.8, 0.01);
  pair.world.joints().set_target_velocity(pair.joint, -1, 0);
  pair.world.advance(3, kStep);
  EXPECT_NEAR(pair.world.joints().position(pair.joint, 0), -0.3, 0.01);
}

TEST(Revolute2, SecondAxisIsAnObjectOfItsOwn) {
  Jointed pair(steered_wheel(MotorMode::kVelocity, MotorMode::kVelocity));
  const ObjectId rolling = pair.world.tree().find("/joint/axis2");
  pair.world.joints().set_target_velocity(rolling, 3);
  EXPECT_EQ(pair.world.joints().target_velocity(pair.joint, 1), 3);
  EXPECT_EQ(pair.world.joints().target_velocity(pair.joint, 0), 0);
  pair.world.advance(0.1, kStep);
  EXPECT_EQ(pair.world.joints().position(rolling), pair.world.joints().position(pair.joint, 1));
}

TEST(BallJoint, LeavesAllTurnsFreeAndHoldsThePoint) {
  Jointed pair(joint("ball", {}, {0.5, 0, 0}));
  const Vector3 anchor(0.5, 0, 0);
  pair.world.set_velocity(pair.arm, {Vector3::Zero(), {0.3, 0.7, 1.1}});
  pair.world.advance(1, kStep);
  const Vector3 of_base = pair.world.pose(pair.base) * anchor;
  const Vector3 of_arm = pair.world.pose(pair.arm) * anchor;
  EXPECT_LT((of_base - of_arm).norm(), 2e-3);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_GT(std::abs(turn_about(Vector3::Unit(axis), pair.world.pose(pair.base), pair.world.pose(pair.arm))), 0.02);
  }
}

TEST(FixedJoint, MovesBothLinksAsOne) {
  Jointed pair(joint("fixed", {}));
  const Pose before = pair.arm_in_base();
  pair.world.set_velocity(pair.arm, {{1, 0, 0}, {0, 0, 1}});
  pair.world.advance(1, kStep);
  EXPECT_LT((pair.arm_in_base().position - before.position).norm(), 1e-3);
  EXPECT_NEAR(turn_about(Vector3::UnitZ(), pair.world.pose(pair.base), pair.world.pose(pair.arm)), 0, 1e-3);
  EXPECT_NEAR(pair.world.velocity(pair.base).linear.x(), 0.5, 0.01) << "two equal masses share the momentum";
}

TEST(FixedJoint, HoldsALinkInTheWorld) {
  SceneDescription described = jointed(joint("fixed", {}, {}, "world"));
  described.gravity = {0, 0, -9.81};
  World world(described, 0);
  world.advance(1, kStep);
  EXPECT_LT(world.pose(world.tree().find("/arm")).position.norm(), 1e-6);
}

TEST(JointWithoutAxes, HasNoPosition) {
  for (const char* type : {"fixed", "ball"}) {
    const Jointed pair(joint(type, {}));
    EXPECT_THROW(pair.world.joints().position(pair.joint), WrongObject) << type;
  }
}

TEST(JointPose, IsAttachedToTheParentAndItsMovingFrameToTheChild) {
  Jointed pair(joint("revolute", {axis(Vector3::UnitZ(), MotorMode::kVelocity)}, {1, 0, 0}));
  EXPECT_LT((pair.world.pose(pair.joint).position - Vector3(1, 0, 0)).norm(), 1e-12);
  pair.world.joints().set_target_velocity(pair.joint, 0.5);
  pair.world.advance(2, kStep);
  const Pose still = pair.world.pose(pair.joint);
  const Pose moving = pair.world.joints().child_pose(pair.joint);
  EXPECT_LT((still.position - moving.position).norm(), 1e-3);
  EXPECT_NEAR(turn_about(Vector3::UnitZ(), pair.world.pose(pair.base), still), 0, 1e-9);
  EXPECT_NEAR(turn_about(Vector3::UnitZ(), still, moving), pair.world.joints().position(pair.joint), 1e-6);
}

}  // namespace
}  // namespace bubblesim::test::test_joint_axes
