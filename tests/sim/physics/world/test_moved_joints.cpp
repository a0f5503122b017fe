// SPDX-License-Identifier: BSD-3-Clause
// Hinges that are put elsewhere between their links during a run.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "bubblesim/error.hpp"
#include "bubblesim/world.hpp"
#include "near.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_moved_joints {
namespace {

constexpr double kGravity = 9.81;
constexpr double kStep = 0.001;

/// A link of 1 kg and 1 kg m^2 that hangs 1 m below a hinge about y at the origin.
SceneDescription pendulum(AxisDescription turning, Solver solver) {
  ModelDescription model;
  model.name = "Pendulum";
  model.links.push_back(link("arm", {0, 0, -1}));
  model.joints.push_back(joint("revolute", {std::move(turning)}, {}, "world"));
  SceneDescription described = scene({model}, {0, 0, -kGravity});
  described.solver = solver;
  return described;
}

class MovedHinge : public ::testing::TestWithParam<Solver> {
 protected:
  World world_with(AxisDescription turning) const { return {pendulum(std::move(turning), GetParam()), 0}; }
};

ObjectId hinge_of(const World& world) { return world.tree().find("/joint"); }
ObjectId arm_of(const World& world) { return world.tree().find("/arm"); }

/// The time of ten small swings about y from a lean of 0.02 rad.
double ten_swings(World& world) {
  const ObjectId arm = arm_of(world);
  double before = 0;
  double first = 0;
  int crossings = 0;
  for (int i = 1; i < 100000; ++i) {
    world.advance(kStep, kStep);
    const double now = world.velocity(arm).angular.y();
    if (before * now < 0) {
      const double time = (i - now / (now - before)) * kStep;
      if (crossings == 0) first = time;
      if (++crossings == 21) return time - first;
    }
    before = now;
  }
  return 0;
}

TEST_P(MovedHinge, ThePendulumSwingsAboutItsNewPlace) {
  World world = world_with(axis(Vector3::UnitY()));
  const Vector3 up(0, 0, 1);
  world.set_pose(hinge_of(world), at(0.04, 0, 1));  // 2 m above the centre of mass, and aside
  expect_near(world.pose(hinge_of(world)), at(0.04, 0, 1), 1e-12);
  EXPECT_EQ(world.joints().position(hinge_of(world)), 0);
  // 2 pi sqrt((I + m l^2) / (m g l))
  const double length = std::hypot(0.04, 2);
  const double period = 2 * M_PI * std::sqrt((1 + length * length) / (kGravity * length));
  EXPECT_NEAR(ten_swings(world) / (10 * period), 1, 1e-3);
}

TEST_P(MovedHinge, TheAxisTurnsWithTheFrame) {
  World world = world_with(axis(Vector3::UnitY(), MotorMode::kVelocity));
  world.set_pose(hinge_of(world), {{0, 0, -1}, from_rpy(M_PI / 2, 0, 0)});  // y becomes z
  world.joints().set_target_velocity(hinge_of(world), 1.5);
  world.advance(2, kStep);
  const Twist motion = world.velocity(arm_of(world));
  EXPECT_LT((motion.angular - Vector3(0, 0, 1.5)).norm(), 1e-9);
  EXPECT_LT(motion.linear.norm(), 1e-9);
  EXPECT_NEAR(world.joints().position(hinge_of(world)), 3, 2e-3);
}

TEST_P(MovedHinge, MotorsStopsAndEffortsFollow) {
  AxisDescription turning = axis(Vector3::UnitY(), MotorMode::kPosition);
  turning.lower = -0.5;
  turning.upper = 0.5;
  turning.damping = 0.1;
  turning.friction = 0.01;
  World world = world_with(turning);
  const ObjectId hinge = hinge_of(world);
  world.set_pose(hinge, {{0.3, 0, -1}, from_rpy(0, 0, M_PI)});  // 0.3 m beside the centre of mass; y becomes -y
  world.joints().set_target_position(hinge, 0.4);
  world.advance(5, kStep);
  EXPECT_NEAR(world.joints().position(hinge), 0.4, 1e-3);
  const Vector3 to_centre = world.pose(arm_of(world)).position - Vector3(0.3, 0, -1);
  EXPECT_LT((to_centre - from_rpy(0, -0.4, 0) * Vector3(-0.3, 0, 0)).norm(), 1e-3);
  // It holds the weight on its lever: about -y, with a lever along -x, m g cos(angle) l.
  EXPECT_NEAR(world.joints().motor_effort(hinge), -kGravity * 0.3 * std::cos(0.4), 0.02);
  world.joints().set_motor_mode(hinge, MotorMode::kVelocity);
  world.joints().set_target_velocity(hinge, 2);
  world.advance(2, kStep);
  EXPECT_NEAR(world.joints().position(hinge), 0.5, 1e-4);
}

TEST_P(MovedHinge, ItsPositionStays) {
  World world = world_with(axis(Vector3::UnitY()));
  const ObjectId hinge = hinge_of(world);
  world.joints().set_position(hinge, 0.7);
  const Pose arm = world.pose(arm_of(world));
  world.set_pose(hinge, {{0.2, 0.1, 0}, from_rpy(0.3, 0.2, 0.1)});
  EXPECT_NEAR(world.joints().position(hinge), 0.7, 1e-12);
  expect_near(world.pose(arm_of(world)), arm, 1e-12);
}

TEST_P(MovedHinge, ItsFrameIsAPartOfTheState) {
  AxisDescription turning = axis(Vector3::UnitY(), MotorMode::kEffort);
  turning.lower = -1;
  turning.upper = 1;
  World world = world_with(turning);
  const std::uint64_t first = world.state_hash();
  world.set_pose(hinge_of(world), {{0.1, 0, 0}, from_rpy(0.2, 0, 0.3)});
  EXPECT_NE(world.state_hash(), first);
  world.advance(0.5, kStep);
  const std::string state = saved(world);
  World again = world_with(turning);
  restore(state, again);
  EXPECT_EQ(again.state_hash(), world.state_hash());
  for (World* each : {&world, &again}) {
    each->joints().set_target_effort(hinge_of(*each), 2);
    each->advance(0.5, kStep);
  }
  EXPECT_EQ(again.state_hash(), world.state_hash());
  again.reset();
  EXPECT_EQ(again.state_hash(), first);
  World fresh = world_with(turning);
  for (World* each : {&fresh, &again}) each->advance(0.5, kStep);
  EXPECT_EQ(again.state_hash(), fresh.state_hash());
}

TEST_P(MovedHinge, AModelMovesWithItsHingeToTheWorld) {
  World world = world_with(axis(Vector3::UnitY()));
  const Pose wanted(3, 2, 1, 0, 0, 0.5);
  const Pose motion = wanted * world.pose(world.tree().find("/Pendulum")).inverse();
  const Pose hinge = motion * world.pose(hinge_of(world));
  world.set_pose(world.tree().find("/Pendulum"), wanted);
  expect_near(world.pose(hinge_of(world)), hinge, 1e-12);
  world.advance(1, kStep);
  EXPECT_LT((world.pose(arm_of(world)).position - (hinge.position - Vector3(0, 0, 1))).norm(), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Solvers, MovedHinge, ::testing::Values(Solver::kBubblesim, Solver::kOde));

TEST(JointsThatStay, AreRefused) {
  World world(jointed(joint("prismatic", {axis(Vector3::UnitX())})), 0);
  const std::uint64_t before = world.state_hash();
  try {
    world.set_pose(hinge_of(world), at(1, 0, 0));
    FAIL();
  } catch (const WrongObject& error) {
    EXPECT_NE(std::string(error.what()).find("it cannot be moved on its own; move its link or model"),
              std::string::npos);
  }
  EXPECT_EQ(world.state_hash(), before);
}

}  // namespace
}  // namespace bubblesim::test::test_moved_joints
