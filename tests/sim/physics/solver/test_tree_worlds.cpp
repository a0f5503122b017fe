// SPDX-License-Identifier: BSD-3-Clause
// Models with joints in worlds, which trees solve by default.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "near.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_tree_worlds {
namespace {

constexpr double kGravity = 9.81;
constexpr double kStep = 0.005;

World by_trees(std::vector<ModelDescription> models, const Vector3& gravity = {0, 0, -kGravity}) {
  return World(scene(std::move(models), gravity), 0);
}

/// A rod of 1 m and 1 kg that hangs from the world and leans by an angle about y.
ModelDescription pendulum(double angle, AxisDescription hinge_axis = axis(Vector3::UnitY())) {
  LinkDescription rod = link("rod");
  rod.centre_of_mass = {0, 0, -0.5};
  rod.inertia_diagonal = Vector3(1.0 / 12, 1.0 / 12, 1e-3);
  rod.pose = Pose(Vector3(), from_rpy(0, angle, 0));
  ModelDescription made = model("Pendulum", rod);
  made.joints.push_back(joint("revolute", {std::move(hinge_axis)}, {}, "world", "rod"));
  return made;
}

TEST(PendulumByTrees, HasThePeriodOfTheory) {
  constexpr double kStart = 170 * M_PI / 180;
  World world = by_trees({pendulum(kStart)});
  const ObjectId hinge = world.tree().find("/joint");
  const double period = 4 * std::comp_ellint_1(std::sin(kStart / 2)) * std::sqrt(1.0 / 3 / (kGravity * 0.5));
  std::vector<double> crossings;
  double before = kStart;
  for (int i = 1; crossings.size() < 21 && i * kStep < 12 * period; ++i) {
    world.advance(kStep, kStep);
    const double now = std::remainder(world.joints().position(hinge) + kStart, 2 * M_PI);
    if (now * before < 0 && std::abs(now) < 1) crossings.push_back((i - now / (now - before)) * kStep);
    before = now;
  }
  ASSERT_EQ(crossings.size(), 21u);
  EXPECT_NEAR((crossings.back() - crossings.front()) / (10 * period), 1, 5e-3);
}

TEST(MotorByTrees, HoldsARodAndReportsTheTorqueOfItsWeight) {
  AxisDescription hinge = axis(Vector3::UnitY(), MotorMode::kVelocity);
  World world = by_trees({pendulum(-M_PI / 2, hinge)});
  const ObjectId joint = world.tree().find("/joint");
  world.advance(1, kStep);
  EXPECT_NEAR(world.joints().position(joint), 0, 1e-6);
  EXPECT_NEAR(std::abs(world.joints().motor_effort(joint)), kGravity / 2, 1e-3);
}

TEST(StopByTrees, HoldsARodAtItsLimit) {
  AxisDescription hinge = axis(Vector3::UnitY());
  hinge.lower = -0.3;
  hinge.upper = 0.3;
  World world = by_trees({pendulum(-M_PI / 2, hinge)});
  world.advance(3, kStep);
  EXPECT_NEAR(std::abs(world.joints().position(world.tree().find("/joint"))), 0.3, 1e-4);
}

TEST(StopByTrees, HoldsARodWhoseFixedPostTouchesTheFloor) {
  AxisDescription hinge = axis(Vector3::UnitY());
  hinge.lower = -0.3;
  hinge.upper = 0.3;
  ModelDescription robot = pendulum(-M_PI / 2, hinge);
  LinkDescription post = link_with(Box{{0.1, 0.1, 1}});
  post.name = "post";
  post.pose = at(0, 1, 0.5 - 1e-4);
  robot.pose = at(0, 0, 3);
  robot.links.insert(robot.links.begin(), post);
  robot.links.front().pose.position.z() -= 3;
  robot.joints[0].parent = "post";
  robot.joints.push_back(joint("fixed", {}, {}, "world", "post"));
  robot.joints.back().name = "mount";
  World world = by_trees({floor(), robot});
  world.advance(3, kStep);
  EXPECT_NEAR(std::abs(world.joints().position(world.tree().find("/joint"))), 0.3, 1e-4);
}

TEST(FloatingRobotByTrees, KeepsItsMomentumWhileItsMotorTurns) {
  LinkDescription base = link("base");
  LinkDescription arm = link("arm");
  base.mass = 3;
  base.inertia_diagonal = Vector3(0.2, 0.4, 0.3);
  arm.inertia_diagonal = Vector3(0.05, 0.1, 0.12);
  arm.pose = at(0.5, 0.1, 0.2);
  ModelDescription robot = model("Robot", base, at(0, 0, 5));
  robot.links.push_back(arm);
  robot.joints.push_back(
      joint("continuous", {axis(Vector3(0, 0.6, 0.8), MotorMode::kVelocity)}, {-0.4, 0, 0}, "base", "arm"));
  World world = by_trees({robot}, Vector3::Zero());
  world.joints().set_target_velocity(world.tree().find("/joint"), 8);
  world.advance(5, kStep);
  Vector3 linear;
  Vector3 angular;
  double moved = 0;
  for (const LinkDescription& part : {base, arm}) {
    const ObjectId body = world.tree().find("/Robot/" + part.name);
    const Pose pose = world.pose(body);
    const Twist velocity = world.velocity(body);
    const Vector3 spin = pose.orientation.conjugate() * velocity.angular;
    linear += velocity.linear * part.mass;
    angular += pose.position.cross(velocity.linear) * part.mass;
    angular += pose.orientation * Vector3(part.inertia_diagonal.cwiseProduct(spin));
    moved += velocity.angular.norm();
  }
  EXPECT_GT(moved, 1);
  expect_near(linear, {}, 1e-11);  // as at the start
  expect_near(angular, {}, 1e-11);
}

TEST(RopeByTrees, GainsNoEnergyByAWhip) {
  constexpr int kPieces = 40;
  constexpr double kLength = 0.025;
  constexpr double kMass = 1e-3;
  const Vector3 inertia(6e-8, 6e-8, 1e-8);
  ModelDescription rope;
  for (int i = 0; i < kPieces; ++i) {
    LinkDescription piece = link("p" + std::to_string(i));
    piece.mass = kMass;
    piece.inertia_diagonal = inertia;
    piece.pose = Pose(Vector3(i * kLength, 0, 0), from_rpy(0, M_PI / 2, 0));
    if (i == 0) {
      rope = model("Rope", piece, at(0, 0, 5));
      continue;
    }
    rope.links.push_back(piece);
    rope.joints.push_back(joint("ball", {}, {0, 0, -kLength / 2}, "p" + std::to_string(i - 1), piece.name));
    rope.joints.back().name = "j" + std::to_string(i);
  }
  World world = by_trees({rope}, Vector3::Zero());
  const auto energy = [&] {
    double sum = 0;
    for (int i = 0; i < kPieces; ++i) {
      const ObjectId piece = world.tree().find("/Rope/p" + std::to_string(i));
      const Twist velocity = world.velocity(piece);
      const Vector3 spin = world.pose(piece).orientation.conjugate() * velocity.angular;
      sum += (kMass * velocity.linear.squaredNorm() + spin.dot(inertia.cwiseProduct(spin))) / 2;
    }
    return sum;
  };
  world.wrenches().apply(world.tree().find("/Rope/p20"), {{0, 20, 5}, {}});
  world.advance(kStep, kStep);
  const double start = energy();
  EXPECT_GT(start, 0.1);
  for (int i = 0; i < 200; ++i) {
    world.advance(kStep, kStep);
    ASSERT_LT(energy(), 1.05 * start) << i;
  }
}

}  // namespace
}  // namespace bubblesim::test::test_tree_worlds
