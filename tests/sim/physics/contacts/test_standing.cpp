// SPDX-License-Identifier: BSD-3-Clause
// Robots without commands stand still and upright, however many contact points their wheels have.
#include <gtest/gtest.h>

#include "scenes.hpp"
#include "surfaces.hpp"

namespace bubblesim::test::test_standing {
namespace {

constexpr double kStep = 0.005;
constexpr double kRadius = 0.0625;  // m, of all wheels

/// The inertia of a cylinder about its y axis.
Vector3 inertia_of_wheel(double mass, double width) {
  const double across = mass * (3 * kRadius * kRadius + width * width) / 12;
  return {across, mass * kRadius * kRadius / 2, across};
}

/// A wheel with a tyre and a rim, as in robot files: `shapes` cylinders side by side on one axle.
LinkDescription wheel(const std::string& name, double x, double y, int shapes, double min_depth) {
  LinkDescription wheel = link(name, {x, y, kRadius});
  wheel.mass = 1;
  wheel.inertia_diagonal = inertia_of_wheel(1, 0.032);
  for (int i = 0; i < shapes; ++i) {
    wheel.collisions.push_back(shape(Cylinder{kRadius, 0.03 + 0.02 * i}));
    wheel.collisions.back().name += std::to_string(i);
    wheel.collisions.back().pose = Pose(0, 0, 0, M_PI / 2, 0, 0);
    wheel.collisions.back().surface.min_depth = min_depth;
  }
  return wheel;
}

JointDescription hinge(const std::string& parent, const std::string& child, const Vector3& anchor,
                       const Vector3& direction, MotorMode motor) {
  JointDescription made = joint("revolute", {axis(direction, motor)}, anchor, parent, child);
  made.name = child + "_joint";
  if (motor != MotorMode::kNone) made.axes[0].max_force = 10;
  return made;
}

/// A base of 58 kg on two driven wheels and four swivel casters.
ModelDescription carrier(int shapes, double min_depth, const Pose& pose) {
  LinkDescription base = link("base");
  base.mass = 58;
  base.centre_of_mass = {0.04, 0, 0.2};
  base.inertia_diagonal = {2, 4.3, 5.5};
  ModelDescription robot = model("Robot", base, pose);
  for (const double y : {0.22, -0.22}) {
    const std::string name = y > 0 ? "left" : "right";
    robot.links.push_back(wheel(name, 0, y, shapes, min_depth));
    robot.joints.push_back(hinge("base", name, {0, y, kRadius}, Vector3::UnitY(), MotorMode::kVelocity));
  }
  for (const double x : {0.34, -0.27}) {
    for (const double y : {0.2, -0.2}) {
      const std::string name = std::string(x > 0 ? "front" : "back") + (y > 0 ? "_left" : "_right");
      LinkDescription fork = link(name + "_fork", {x, y, 0.15});
      fork.mass = 0.3;
      fork.inertia_diagonal = {6e-4, 5e-4, 2e-4};
      robot.links.push_back(fork);
      robot.joints.push_back(hinge("base", fork.name, {x, y, 0.15}, Vector3::UnitZ(), MotorMode::kNone));
      robot.links.push_back(wheel(name, x - 0.04, y, shapes, min_depth));
      robot.joints.push_back(hinge(fork.name, name, {x - 0.04, y, kRadius}, Vector3::UnitY(), MotorMode::kNone));
    }
  }
  return robot;
}

/// A wheel about y as a mesh of `segments` flat faces and two sides.
TriangleMesh wheel_triangles(double radius, double width, std::size_t segments) {
  TriangleMesh mesh;
  const auto add = [&mesh](double x, double y, double z) {
    mesh.vertices.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
  };
  for (const double y : {-width / 2, width / 2}) {
    add(0, y, 0);
    for (std::size_t i = 0; i < segments; ++i) {
      const double angle = 2 * M_PI * static_cast<double>(i) / static_cast<double>(segments);
      add(radius * std::cos(angle), y, radius * std::sin(angle));
    }
  }
  const auto other = static_cast<std::uint32_t>(segments + 1);
  for (std::uint32_t i = 0; i < segments; ++i) {
    const std::uint32_t here = i + 1;
    const auto next = static_cast<std::uint32_t>((i + 1) % segments + 1);
    mesh.triangles.push_back({here, next + other, next});
    mesh.triangles.push_back({here, here + other, next + other});
    mesh.triangles.push_back({0, here, next});
    mesh.triangles.push_back({other, next + other, here + other});
  }
  return mesh;
}

/// A rover of 4 kg whose four driven wheels have a hard rim inside a mesh, with less friction across than along.
ModelDescription rover() {
  LinkDescription base = link("base", {0, 0, 0.15});
  base.mass = 4.4;
  base.centre_of_mass = {-0.01, 0.005, -0.03};
  base.inertia_diagonal = {0.05, 0.07, 0.09};
  ModelDescription robot = model("Robot", base);
  Surface tyre;
  tyre.mu = 3;
  tyre.mu2 = 0.5;
  tyre.fdir1 = Vector3::UnitX();
  tyre.kp = 1e6;
  tyre.kd = 100;
  tyre.min_depth = 0.003;
  for (const double x : {0.15, -0.15}) {
    for (const double y : {0.27, -0.27}) {
      const std::string name = std::string(x > 0 ? "front" : "rear") + (y > 0 ? "_left" : "_right");
      LinkDescription made = wheel(name, x, y, 1, 0.003);
      made.mass = 0.28;
      made.inertia_diagonal = {4e-4, 5e-4, 4e-4};
      made.collisions[0].surface = tyre;
      CollisionDescription mesh = shape(Mesh{finish_mesh(wheel_triangles(0.0622, 0.07, 24))});
      mesh.name = "mesh";
      mesh.surface = tyre;
      made.collisions.push_back(mesh);
      robot.links.push_back(made);
      robot.joints.push_back(hinge("base", name, {x, y, kRadius}, Vector3::UnitY(), MotorMode::kVelocity));
    }
  }
  return robot;
}

double lean(const Pose& pose) { return std::acos((pose.orientation * Vector3::UnitZ()).z()); }

/// Drops a robot slightly tilted, lets it settle, and measures its motion for half a minute.
void expect_to_stand(int shapes, double min_depth) {
  SCOPED_TRACE(std::to_string(shapes) + " shapes a wheel, min_depth " + std::to_string(min_depth));
  World world(scene({floor(), carrier(shapes, min_depth, Pose(0, 0, 0.02, 0.01, 0.02, 0))}), 3);
  const ObjectId robot = world.tree().find("/Robot");
  world.advance(5, kStep);
  const Pose before = world.pose(robot);
  world.advance(30, kStep);
  const Pose after = world.pose(robot);
  // Each wheel rests within a millimetre above its allowed penetration: over 0.4 m that is at most 0.14 degrees.
  EXPECT_LT(lean(after), 0.001 / 0.4);
  EXPECT_LE(after.position.z(), 1e-4 - (min_depth - 0.001));
  EXPECT_GE(after.position.z(), -1e-4 - min_depth);
  // A loaded contact yields slowly within the layer of a millimetre, but nothing creeps sideways.
  const Vector3 moved = after.position - before.position;
  EXPECT_LT(std::hypot(moved.x(), moved.y()), 1e-4);
  EXPECT_LT(std::abs(moved.z()), 1e-3);
  EXPECT_LT(std::abs(to_rpy(after.orientation * before.orientation.inverse()).z()), 1e-3);
}

TEST(Robot, StandsOnWheelsThatTouchInManyPoints) {
  for (const int shapes : {1, 2, 3}) expect_to_stand(shapes, 0.001);
}

TEST(Robot, StandsOnMeshesAfterTurningInPlace) {
  World world(scene({floor(), rover()}), 3);
  const auto turn = [&world](double speed) {
    for (const std::string row : {"front", "rear"}) {
      world.joints().set_target_velocity(world.tree().find("/" + row + "_left_joint"), -speed);
      world.joints().set_target_velocity(world.tree().find("/" + row + "_right_joint"), speed);
    }
  };
  const ObjectId robot = world.tree().find("/Robot");
  turn(5);
  world.advance(3, kStep);
  EXPECT_GT(std::abs(to_rpy(world.pose(robot).orientation).z()), 0.1);
  turn(0);
  world.advance(6, kStep);
  const Pose before = world.pose(robot);
  world.advance(30, kStep);
  EXPECT_LT((world.pose(robot).position - before.position).norm(), 1e-4);
  EXPECT_LT(std::abs(to_rpy(world.pose(robot).orientation * before.orientation.inverse()).z()), 1e-4);
}

TEST(Robot, StandsUprightOnWheelsThatMaySinkIn) {
  for (const int shapes : {1, 2}) expect_to_stand(shapes, 0.01);
}

}  // namespace
}  // namespace bubblesim::test::test_standing
