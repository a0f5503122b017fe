// SPDX-License-Identifier: BSD-3-Clause
// Friction under load transfer and in all directions, compared with Coulomb's law.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>
#include <utility>

#include "scenes.hpp"

namespace bubblesim::test::test_friction {
namespace {

constexpr double kG = 9.81;  // m/s^2
constexpr double kStep = 0.005;
constexpr double kDegree = M_PI / 180;

LinkDescription solid(const std::string& name, double mass, const Vector3& size, const Vector3& position = {}) {
  LinkDescription made = link(name, position);
  made.mass = mass;
  made.inertia_diagonal = Vector3(size.y() * size.y() + size.z() * size.z(), size.x() * size.x() + size.z() * size.z(),
                                  size.x() * size.x() + size.y() * size.y()) *
                          (mass / 12);
  return made;
}

ModelDescription block(double mu, double mass = 1, const Vector3& size = {0.2, 0.2, 0.1}, const Pose& pose = {}) {
  LinkDescription made = solid("link", mass, size);
  made.collisions.push_back(shape(Box{size}, mu));
  return model("Block", made, pose);
}

/// Adds a link without a shape on a fixed joint: the model is then solved by the exact solver, as robots are.
ModelDescription with_joint(ModelDescription made) {
  LinkDescription mast = solid("mast", 1e-3, {0.1, 0.1, 0.1});
  mast.pose = made.links[0].pose;
  made.links.push_back(mast);
  made.joints.push_back(joint("fixed", {}, {}, made.links[0].name, "mast"));
  return made;
}

ModelDescription maybe_jointed(bool jointed, ModelDescription made) {
  return jointed ? with_joint(std::move(made)) : std::move(made);
}

Vector3 inclined(double angle, double direction) {
  return Vector3(std::sin(angle) * std::cos(direction), std::sin(angle) * std::sin(direction), -std::cos(angle)) * kG;
}

struct Wheel {
  double x = 0;
  double y = 0;
  bool driven = true;
};

/// A body of 10 kg at height `h` on light spherical wheels of 0.1 m.
ModelDescription cart(const std::vector<Wheel>& wheels, double h, double mu, const Pose& pose = {}) {
  LinkDescription base = solid("base", 10, {0.6, 0.4, 0.2});
  base.centre_of_mass = {0, 0, h};
  ModelDescription made = model("Cart", base, pose);
  int number = 0;
  for (const Wheel& wheel : wheels) {
    const std::string name = "wheel" + std::to_string(number++);
    LinkDescription turning = solid(name, 0.05, {0.1, 0.1, 0.1}, {wheel.x, wheel.y, 0.1});
    turning.collisions.push_back(shape(Sphere{0.1}, mu));
    made.links.push_back(turning);
    JointDescription axle =
        joint("revolute", {axis(Vector3::UnitY(), wheel.driven ? MotorMode::kVelocity : MotorMode::kNone)},
              {wheel.x, wheel.y, 0.1}, "base", name);
    axle.name = name + "_joint";
    axle.axes[0].max_force = wheel.driven ? 100 : 0;
    made.joints.push_back(axle);
  }
  return made;
}

/// A pile far away, which needs another solver.
std::vector<ModelDescription> heap() {
  std::vector<ModelDescription> models;
  for (int i = 0; i < 8; ++i) {
    models.push_back(block(0.8, 1, {0.3, 0.3, 0.3}, at(50 + 0.03 * i, 0.02 * i, 0.15 + 0.3 * i)));
    models.back().name = "Heap" + std::to_string(i);
  }
  return models;
}

/// The deceleration by the rear or the front axle: of a cart with the common centre of mass in the middle, at a height
/// of `ratio` times the wheelbase of 0.5 m. `sign`: 1 forward, -1 backward, where the rear axle leads.
double deceleration(bool rear, bool far_heap, double mu = 0.5, double ratio = 0.6, double sign = 1) {
  std::vector<ModelDescription> models{
      floor(mu), cart({{0.25, 0.2, !rear}, {0.25, -0.2, !rear}, {-0.25, 0.2, rear}, {-0.25, -0.2, rear}},
                      (ratio * 0.5 * 10.2 - 0.2 * 0.1) / 10, mu)};
  if (far_heap) {
    for (ModelDescription& model : heap()) models.push_back(std::move(model));
  }
  World world(scene(std::move(models)), 0);
  const ObjectId id = world.tree().find("/Cart");
  world.advance(0.5, kStep);
  const double speed = 10 * sign;
  for (int i = 0; i < 4; ++i) {
    const ObjectId wheel = world.tree().find("/wheel" + std::to_string(i));
    world.set_velocity(wheel, {{speed, 0, 0}, {0, (i < 2) == rear ? speed / 0.1 : 0.0, 0}});
  }
  world.set_velocity(world.tree().find("/base"), {{speed, 0, 0}, {}});
  world.advance(0.1, kStep);
  const double before = world.velocity(id).linear.x();
  world.advance(0.5, kStep);
  return sign * (before - world.velocity(id).linear.x()) / 0.5;
}

TEST(Braking, FollowsTheLoadsOfTheAxles) {
  // m a = mu N; N = m (g / 2 -+ a h / L): a = mu g / 2 / (1 +- mu h / L)
  for (const double sign : {1.0, -1.0}) {
    for (const double mu : {0.3, 0.5, 1.0, 1.5}) {
      for (const double ratio : {0.3, 0.45, 0.56, 0.7}) {
        const double trailing = mu * kG / 2 / (1 + mu * ratio);
        EXPECT_NEAR(deceleration(sign > 0, false, mu, ratio, sign), trailing, 0.01 * trailing) << mu << " " << ratio;
        if (mu * ratio > 0.46) continue;  // it would tip over
        const double leading = mu * kG / 2 / (1 - mu * ratio);
        EXPECT_NEAR(deceleration(sign < 0, false, mu, ratio, sign), leading, 0.01 * leading) << mu << " " << ratio;
      }
    }
  }
}

TEST(Braking, DoesNotDependOnAPileFarAway) {
  EXPECT_EQ(deceleration(true, true), deceleration(true, false));
  EXPECT_EQ(deceleration(false, true), deceleration(false, false));
}

TEST(Landing, GivesNoMoreFrictionThanTheImpactAllows) {
  // In each substep, |sum of friction| <= mu times the sum of the normal forces.
  const double mu = 1;
  for (const double speed : {0.5, 2.0, 6.0}) {
    ModelDescription lands = cart({{0.25, 0.2}, {0.25, -0.2}, {-0.25, 0.2}, {-0.25, -0.2}}, 0.35, mu, at(0, 0, 0.1));
    World world(scene({floor(mu), lands}), 0);
    const auto momentum = [&] {
      const ObjectId base = world.tree().find("/base");
      const Twist velocity = world.velocity(base);  // of its origin; the centre of mass is at 0.35 m
      Vector3 sum = (velocity.linear + velocity.angular.cross(world.pose(base).orientation * Vector3(0, 0, 0.35))) * 10;
      for (int i = 0; i < 4; ++i) sum += world.velocity(world.tree().find("/wheel" + std::to_string(i))).linear * 0.05;
      return sum;
    };
    world.set_velocity(world.tree().find("/Cart"), {{speed, 0, 0}, {}});
    Vector3 before = momentum();
    for (int i = 0; i < 200; ++i) {
      world.advance(kStep, kStep);
      const Vector3 now = momentum();
      const double pressed = now.z() - before.z() + 10.2 * kG * kStep;
      const double slowed = std::hypot(now.x() - before.x(), now.y() - before.y());
      EXPECT_LE(slowed, 1.06 * mu * pressed + 1e-3) << speed << " " << i;
      before = now;
    }
  }
}

double ladder_slides(bool jointed, double mu, double angle) {
  const double length = 2;
  const Vector3 size{length, 0.3, 0.02};
  // Lower corner on the floor at x = 0, upper corner at the wall; rotated about y so that it rises along x.
  const Quaternion turned = from_rpy(0, -angle, 0);
  const Vector3 up = turned * Vector3(0, 0, 1);
  const Vector3 centre = turned * Vector3(length / 2, 0, 0) + up * 0.01;
  const double overlap = 0.0005;
  const Vector3 low = centre + turned * Vector3(-length / 2, 0, -0.01);
  const Vector3 top = centre + turned * Vector3(length / 2, 0, -0.01);
  ModelDescription ladder =
      maybe_jointed(jointed, block(mu, 5, size, Pose(centre - Vector3(0, 0, low.z() + overlap), turned)));
  ModelDescription wall = still(model("Wall", link_with(Box{{0.2, 2, 6}}, mu), at(top.x() + 0.1 - overlap, 0, 3)));
  World world(scene({floor(mu), wall, ladder}), 0);
  const ObjectId id = world.tree().find("/Block");
  world.advance(0.5, kStep);
  const Pose before = world.pose(id);
  world.advance(2, kStep);
  return (world.pose(id).position - before.position).norm();
}

class BothSolvers : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Friction, BothSolvers, testing::Bool(),
                         [](const auto& info) { return info.param ? "Exact" : "Own"; });

TEST_P(BothSolvers, LadderHoldsAboveItsLeastAngle) {
  for (const double mu : {0.5, 0.8}) {
    const double least = std::atan((1 - mu * mu) / (2 * mu));
    EXPECT_LT(ladder_slides(GetParam(), mu, least + kDegree), 5e-3) << mu;
    EXPECT_GT(ladder_slides(GetParam(), mu, least - kDegree), 2e-2) << mu;
  }
}

TEST_P(BothSolvers, SlopeHoldsInAnyDirectionUpToTheAngleOfFriction) {
  const double mu = 0.5;
  for (const double direction : {0.0, 20.0, 45.0, 70.0, 135.0, 222.0}) {
    const auto slide = [&](double angle) {
      World world(scene({floor(mu), maybe_jointed(GetParam(), block(mu, 1, {0.2, 0.2, 0.1}, at(0, 0, 0.05)))},
                        inclined(angle, direction * kDegree)),
                  0);
      world.advance(0.5, kStep);
      const ObjectId id = world.tree().find("/Block");
      const double before = world.velocity(id).linear.norm();
      world.advance(1, kStep);
      return world.velocity(id).linear.norm() - before;
    };
    EXPECT_LT(slide(std::atan(mu) - 0.2 * kDegree), 1e-3) << direction;
    EXPECT_GT(slide(std::atan(mu) + 0.2 * kDegree), 1e-2) << direction;
    const double steep = 35 * kDegree;
    const double theory = kG * (std::sin(steep) - mu * std::cos(steep));
    EXPECT_NEAR(slide(steep), theory, 0.02 * theory) << direction;
  }
}

TEST(LockedWheels, StopInTheSameDistanceInAnyDirection) {
  for (const double direction : {0.0, 30.0, 45.0}) {
    World world(scene({floor(), cart({{0.25, 0.2}, {0.25, -0.2}, {-0.25, 0.2}, {-0.25, -0.2}}, 0.15, 0.5)}), 0);
    world.advance(0.5, kStep);
    const ObjectId id = world.tree().find("/base");
    const Vector3 before = world.pose(id).position;
    const Vector3 velocity = Vector3(std::cos(direction * kDegree), std::sin(direction * kDegree), 0) * 2;
    world.set_velocity(world.tree().find("/Cart"), {velocity, {}});
    world.advance(1, kStep);
    const double theory = 2 * 2 / (2 * 0.5 * kG);
    EXPECT_NEAR((world.pose(id).position - before).norm(), theory, 0.03 * theory) << direction;
  }
}

TEST(SkidSteer, TurnsAsTheConeAllows) {
  for (const auto& [half_base, half_track] : {std::pair{0.25, 0.2}, std::pair{0.15, 0.3}, std::pair{0.3, 0.15}}) {
    World world(scene({floor(), cart({{half_base, half_track},
                                      {half_base, -half_track},
                                      {-half_base, half_track},
                                      {-half_base, -half_track}},
                                     0.15, 0.7)}),
                0);
    world.advance(0.5, kStep);
    const double speed = 0.5;
    for (int i = 0; i < 4; ++i) {
      world.joints().set_target_velocity(world.tree().find("/wheel" + std::to_string(i) + "_joint"),
                                         (i % 2 == 0 ? -speed : speed) / 0.1);
    }
    world.advance(1, kStep);
    const double before = to_rpy(world.pose(world.tree().find("/base")).orientation).z();
    world.advance(1, kStep);
    const double turned = to_rpy(world.pose(world.tree().find("/base")).orientation).z() - before;
    // The moments of the forward friction (s - w b) and the sideways friction w a of each wheel cancel out.
    const double theory = speed * half_track / (half_base * half_base + half_track * half_track);
    EXPECT_NEAR(std::remainder(turned, 2 * M_PI), theory, 0.15 * theory) << half_base << " " << half_track;
  }
}

/// A robot that turns in place on two cylinder wheels, with frictionless castors in front and behind.
double spin_with_castors(double mu, double step) {
  LinkDescription base = solid("base", 10, {0.5, 0.4, 0.1});
  base.centre_of_mass = {0, 0, 0.1};
  for (const double x : {0.2, -0.2}) {
    base.collisions.push_back(shape(Sphere{0.05}, 0));
    base.collisions.back().name += x > 0 ? "front" : "back";
    base.collisions.back().pose = at(x, 0, 0.05);
  }
  ModelDescription robot = model("Robot", base);
  for (const double y : {0.2, -0.2}) {
    const std::string name = y > 0 ? "left" : "right";
    LinkDescription wheel = solid(name, 0.5, {0.1, 0.1, 0.1}, {0, y, 0.1});
    wheel.collisions.push_back(shape(Cylinder{0.1, 0.04}, mu));
    wheel.collisions.back().pose = Pose(0, 0, 0, M_PI / 2, 0, 0);
    robot.links.push_back(wheel);
    JointDescription axle =
        joint("revolute", {axis(Vector3::UnitY(), MotorMode::kVelocity)}, {0, y, 0.1}, "base", name);
    axle.name = name + "_joint";
    axle.axes[0].max_force = 20;
    robot.joints.push_back(axle);
  }
  World world(scene({floor(), robot}), 0);
  world.joints().set_target_velocity(world.tree().find("/left_joint"), -5);
  world.joints().set_target_velocity(world.tree().find("/right_joint"), 5);
  world.advance(2, step);
  double turned = 0;
  double before = to_rpy(world.pose(world.tree().find("/base")).orientation).z();
  for (int i = 0; i < 10; ++i) {
    world.advance(0.2, step);
    const double now = to_rpy(world.pose(world.tree().find("/base")).orientation).z();
    turned += std::remainder(now - before, 2 * M_PI);
    before = now;
  }
  return turned / 2;
}

TEST(Castors, LeaveTheWheelsTheirLoad) {
  for (const double mu : {0.5, 0.7, 1.0}) {
    for (const double step : {0.0005, 0.001, 0.005}) {
      EXPECT_NEAR(spin_with_castors(mu, step), 5 * 0.1 / 0.2, 0.12 * 2.5) << mu << " " << step;
    }
  }
}

/// How far a box of 0.5 kg slips within 5 s between two jaws, whose force limit makes it `load` times what they hold.
double slip_between_jaws(double load) {
  const double mu = 0.6;
  const double weight = 0.5 * kG;
  const double force = weight / (2 * mu * load);
  ModelDescription gripper = model("Gripper", solid("palm", 1, {0.1, 0.1, 0.1}, {0, 0, 1}));
  gripper.joints.push_back(joint("fixed", {}, {}, "world", "palm"));
  gripper.joints.back().name = "mount";
  for (const double side : {1.0, -1.0}) {
    const std::string name = side > 0 ? "left" : "right";
    LinkDescription jaw = solid(name, 0.2, {0.02, 0.1, 0.1}, {0.0605 * side, 0, 0.8});
    jaw.collisions.push_back(shape(Box{{0.02, 0.1, 0.1}}, mu));
    gripper.links.push_back(jaw);
    JointDescription slide = joint("prismatic", {axis({-side, 0, 0}, MotorMode::kEffort)}, {0, 0, 1}, "palm", name);
    slide.name = name + "_joint";
    slide.axes[0].max_force = 1000;
    gripper.joints.push_back(slide);
  }
  World world(scene({floor(), gripper, block(mu, 0.5, {0.1, 0.1, 0.1}, at(0, 0, 0.8)),
                     still(model("Table", link_with(Box{{0.1, 0.1, 0.1}}), at(0, 0, 0.7)))}),
              0);
  for (const char* joint : {"/left_joint", "/right_joint"})
    world.joints().set_target_effort(world.tree().find(joint), force);
  world.advance(0.5, kStep);
  world.models().remove(world.tree().find("/Table"));
  const ObjectId box = world.tree().find("/Block");
  const double before = world.pose(box).position.z();
  world.advance(5, kStep);
  return before - world.pose(box).position.z();
}

TEST(Jaws, HoldABoxUpToTheirFriction) {
  for (int i = 0; i < 40; ++i) {
    const double load = 0.05 + 0.9 * i / 39;
    EXPECT_LT(slip_between_jaws(load), 1e-3) << load;
  }
  EXPECT_GT(slip_between_jaws(1.1), 0.1);
}

}  // namespace
}  // namespace bubblesim::test::test_friction
