// SPDX-License-Identifier: BSD-3-Clause
// Rotation of bodies with unequal moments of inertia, compared with Euler's and Lagrange's solutions.
#include <gtest/gtest.h>

#include <cmath>

#include "scenes.hpp"

namespace bubblesim::test::test_rotation {
namespace {

/// A body of 1 kg with the moments `inertia`, kg m^2.
LinkDescription body(const std::string& name, const Vector3& inertia) {
  LinkDescription described = link(name);
  described.inertia_diagonal = inertia;
  return described;
}

/// A body that rotates freely.
class Spinning {
 public:
  Spinning(const Vector3& inertia, const Vector3& velocity)
      : world(scene({model("Body", body("link", inertia))}, Vector3::Zero()), 0), inertia_(inertia) {
    world.set_velocity(id, {{}, velocity});
  }

  Vector3 velocity_in_body() const { return turn().conjugate() * world.velocity(id).angular; }
  Vector3 momentum() const { return turn() * inertia_.cwiseProduct(velocity_in_body()); }
  double energy() const { return velocity_in_body().dot(inertia_.cwiseProduct(velocity_in_body())) / 2; }
  Quaternion turn() const { return world.pose(id).orientation; }

  World world;
  ObjectId id = world.tree().find("/Body");

 private:
  Vector3 inertia_;
};

TEST(FreeRotation, TurnsOverAfterTheTimeOfJacobisFunctions) {
  const Vector3 inertia(1, 2, 3);
  Spinning spinning(inertia, {0.01, 5, 0});
  // With L^2 < 2 E I2: w2 is a Jacobi sn of this rate and parameter; it changes its sign every 2 K.
  const double twice_energy = 2 * spinning.energy();
  const double square = spinning.momentum().squaredNorm();
  ASSERT_LT(square, twice_energy * inertia.y());
  const double fast = (inertia.z() * twice_energy - square) * (inertia.y() - inertia.x());
  const double slow = (square - inertia.x() * twice_energy) * (inertia.z() - inertia.y());
  const double interval =
      2 * std::comp_ellint_1(std::sqrt(slow / fast)) * std::sqrt(inertia.x() * inertia.y() * inertia.z() / fast);
  std::vector<double> turned;
  double before = 1;
  for (int i = 1; turned.size() < 4 && i < 20000; ++i) {
    spinning.world.advance(0.001, 0.001);
    const double now = spinning.velocity_in_body().y();
    if (now * before < 0) turned.push_back(i * 0.001);
    before = now;
  }
  ASSERT_EQ(turned.size(), 4u);
  EXPECT_NEAR((turned[3] - turned[0]) / 3 / interval, 1, 1e-3) << interval << " s";
}

TEST(FreeRotation, KeepsMomentumAndEnergy) {
  for (const double step : {0.001, 0.005}) {
    Spinning spinning({1, 2, 3}, {3, 5, 1});
    const double energy = spinning.energy();
    const Vector3 momentum = spinning.momentum();
    spinning.world.advance(20, step);
    EXPECT_NEAR(spinning.energy() / energy, 1, 1e-6) << step;
    EXPECT_LT((spinning.momentum() - momentum).norm() / momentum.norm(), 1e-10) << step;
  }
}

TEST(FreeRotation, KeepsTheAngleOfItsNutation) {
  Spinning spinning({1, 1, 2}, {1, 0, 10});
  const auto angle = [&] {
    return std::acos((spinning.turn() * Vector3::UnitZ()).dot(spinning.momentum().normalized()));
  };
  const double before = angle();
  spinning.world.advance(20, 0.005);
  EXPECT_NEAR(angle(), before, 1e-6);
}

TEST(FreeRotation, IsStableAtAThousandRadiansPerSecond) {
  Spinning spinning({1, 2, 3}, {300, 900, 300});
  const double energy = spinning.energy();
  const Vector3 momentum = spinning.momentum();
  spinning.world.advance(5, 0.005);
  EXPECT_NEAR(spinning.energy() / energy, 1, 0.01);
  EXPECT_LT((spinning.momentum() - momentum).norm() / momentum.norm(), 1e-9);
}

TEST(FreeRotation, TakesATorqueAsTheRateOfItsMomentum) {
  Spinning spinning({1, 2, 3}, {1, 2, 1});
  const Vector3 momentum = spinning.momentum();
  const Vector3 torque(0.5, -1, 2);
  for (int i = 0; i < 20; ++i) {
    spinning.world.wrenches().apply(spinning.id, {{}, torque});
    spinning.world.advance(0.05, 0.005);
  }
  EXPECT_LT(((spinning.momentum() - momentum) - torque).norm(), 1e-9) << "torque times 1 s";
}

/// A symmetric top of 1 kg on a ball joint, in steady precession: the axis keeps its angle to the vertical.
class Top {
 public:
  static constexpr double kLever = 0.05;     // m, from the joint to the centre of mass
  static constexpr double kAxial = 0.005;    // kg m^2
  static constexpr double kAcross = 0.0026;  // kg m^2, about the centre of mass
  static constexpr double kAngle = 0.5;      // rad, from the vertical
  static constexpr double kGravity = 9.81;   // m/s^2

  explicit Top(double precession) : world(described(), 0) {
    // Lagrange: m g l = A w3 p - B p^2 cos(angle) with the moment B about the joint.
    const double about_joint = kAcross + kLever * kLever;
    const double spin =
        (kGravity * kLever + about_joint * precession * precession * std::cos(kAngle)) / (kAxial * precession);
    const Vector3 angular = Vector3::UnitZ() * precession + axis() * (spin - precession * std::cos(kAngle));
    world.set_velocity(id, {{}, angular});
    speed = angular.norm();
  }

  Vector3 axis() const { return world.pose(id).orientation * Vector3::UnitZ(); }

  World world;
  ObjectId id = world.tree().find("/Top");
  double speed = 0;  // rad/s

 private:
  static SceneDescription described() {
    LinkDescription top = body("top", {kAcross, kAcross, kAxial});
    top.centre_of_mass = {0, 0, kLever};
    ModelDescription made = model("Top", top, Pose(0, 0, 0, 0, kAngle, 0));
    made.joints.push_back(joint("ball", {}, {}, "world", "top"));
    return scene({made}, {0, 0, -kGravity});
  }
};

TEST(ConstrainedRotation, TopPrecessesSteadily) {
  for (const double step : {0.001, 0.005}) {
    Top top(1);
    double angle = 0;
    Vector3 before = top.axis();
    for (int i = 0; i < 100; ++i) {
      top.world.advance(0.05, step);
      const Vector3 now = top.axis();
      angle += std::remainder(std::atan2(now.y(), now.x()) - std::atan2(before.y(), before.x()), 2 * M_PI);
      before = now;
      EXPECT_NEAR(std::acos(now.z()), Top::kAngle, 2e-3) << step;
    }
    EXPECT_NEAR(angle / 5, 1, 5e-3) << "rad/s, with a spin of " << top.speed << " rad/s and substeps of " << step;
  }
}

TEST(ConstrainedRotation, IsStableAtAThousandRadiansPerSecond) {
  Top top(0.1);
  ASSERT_GT(top.speed, 900);
  top.world.advance(5, 0.005);
  EXPECT_LT(top.world.velocity(top.id).angular.norm(), 1.2 * top.speed) << "five radians in a substep";
}

}  // namespace
}  // namespace bubblesim::test::test_rotation
