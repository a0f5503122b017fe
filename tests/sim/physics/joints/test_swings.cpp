// SPDX-License-Identifier: BSD-3-Clause
// Pendulums and chains: the energy of constrained motion.
#include <gtest/gtest.h>

#include <cmath>

#include "scenes.hpp"

namespace bubblesim::test::test_swings {
namespace {

constexpr double kGravity = 9.81;

/// A rod of 1 m that hangs from `parent` and leans by `angle` about y.
void add_rod(ModelDescription& model, const std::string& name, const std::string& parent, const Vector3& from,
             double angle, double mass) {
  LinkDescription rod = link(name);
  rod.mass = mass;
  rod.centre_of_mass = {0, 0, -0.5};
  rod.inertia_diagonal = Vector3(1.0 / 12, 1.0 / 12, 1e-3) * mass;
  rod.pose = Pose(from, from_rpy(0, angle, 0));
  model.links.push_back(rod);
  JointDescription hinge = joint("revolute", {axis(Vector3::UnitY())}, from, parent, name);
  hinge.name = "to_" + name;
  model.joints.push_back(hinge);
}

TEST(Pendulum, KeepsThePeriodOfAWideSwing) {
  constexpr double kStart = 170 * M_PI / 180;
  constexpr double kStep = 0.005;
  ModelDescription pendulum;
  pendulum.name = "Pendulum";
  add_rod(pendulum, "rod", "world", {}, kStart, 1);
  World world(scene({pendulum}, {0, 0, -kGravity}), 0);
  const ObjectId hinge = world.tree().find("/to_rod");
  // 4 K(sin(angle / 2)) sqrt(I / (m g l)) with I = m / 3 and l = 0.5 m.
  const double period = 4 * std::comp_ellint_1(std::sin(kStart / 2)) * std::sqrt(1.0 / 3 / (kGravity * 0.5));
  std::vector<double> crossings;
  const auto angle = [&] { return std::remainder(world.joints().position(hinge) + kStart, 2 * M_PI); };
  double before = angle();
  for (int i = 1; crossings.size() < 21 && i * kStep < 12 * period; ++i) {
    world.advance(kStep, kStep);
    const double now = angle();
    if (now * before < 0 && std::abs(now) < 1) crossings.push_back((i - now / (now - before)) * kStep);
    before = now;
  }
  ASSERT_EQ(crossings.size(), 21u);
  EXPECT_NEAR((crossings.back() - crossings.front()) / (10 * period), 1, 5e-3);
}

/// Rods of 1 kg, a load on the last; the widest gap at a joint in `duration` seconds after the chain is let go.
double widest_gap(int rods, double ratio, double step, double duration) {
  constexpr double kLean = 0.1;  // rad
  ModelDescription chain;
  chain.name = "Chain";
  for (int i = 0; i < rods; ++i) {
    const Vector3 from(-i * std::sin(kLean), 0, -i * std::cos(kLean));
    add_rod(chain, "rod" + std::to_string(i), i == 0 ? "world" : "rod" + std::to_string(i - 1), from, kLean,
            i == rods - 1 ? ratio : 1);
  }
  World world(scene({chain}, {0, 0, -kGravity}), 0);
  double widest = 0;
  for (double time = 0; time < duration; time += 0.05) {
    world.advance(0.05, step);
    for (int i = 1; i < rods; ++i) {
      const ObjectId hinge = world.tree().find("/to_rod" + std::to_string(i));
      widest = std::max(widest, (world.pose(hinge).position - world.joints().child_pose(hinge).position).norm());
    }
  }
  return widest;
}

TEST(Chain, HoldsALoadWithTheSubstepsThatItNeeds) {
  EXPECT_LT(widest_gap(10, 10000, 0.001, 5), 1e-3);
  EXPECT_LT(widest_gap(10, 2000, 0.0025, 5), 1e-3);
}

TEST(DoublePendulum, GoesOnWhenItFliesOffItsStops) {
  // Within a substep from a stop to where none is near: ODE must not write the row of the stop then, for which the
  // problem has no place.
  ModelDescription pendulum;
  pendulum.name = "Pendulum";
  add_rod(pendulum, "upper", "world", {}, -M_PI / 2, 1);
  add_rod(pendulum, "lower", "upper", {1, 0, 0}, -M_PI / 2, 0.2);
  for (JointDescription& hinge : pendulum.joints) {
    hinge.axes[0].lower = -2;
    hinge.axes[0].upper = 2;
  }
  World world(scene({pendulum}, {0, 0, -kGravity}), 0);
  EXPECT_NO_THROW(world.advance(60, 0.001));
  EXPECT_TRUE(world.diverged_models().empty());
}

}  // namespace
}  // namespace bubblesim::test::test_swings
