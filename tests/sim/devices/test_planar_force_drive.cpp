// SPDX-License-Identifier: BSD-3-Clause
// A link that forces push towards a velocity: its errors decay as the gains divided by mass and inertia say.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "bubblesim/error.hpp"
#include "bubblesim/planar_force_drive.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_planar_force_drive {
namespace {

constexpr double kTime = 0.5;  // s

class PlanarForces : public ::testing::Test {
 protected:
  std::shared_ptr<PlanarForceDrive> with_gains(const PlanarForceDrive::Gains& gains) {
    auto drive = std::make_shared<PlanarForceDrive>(world, body, gains);
    world.devices().add(drive, robot);
    return drive;
  }

  /// The velocity along the link's axes.
  Vector3 velocity() const { return world.pose(body).orientation.conjugate() * world.velocity(body).linear; }

  World world{scene({model("Robot", link("link"), Pose(1, 2, 0, 0, 0, M_PI / 2))}, Vector3::Zero()), 0};
  ObjectId robot = world.tree().find("/Robot");
  ObjectId body = world.tree().find("/Robot/link");
  LinkDescription described = world.models().description(robot).links.at(0);
};

/// v(t) = v (1 - exp(-k t / m)), with any substep.
TEST_F(PlanarForces, VelocitiesAreApproachedExponentially) {
  const double mass = described.mass;
  for (const double step : {0.05, 0.001}) {
    world.reset();
    const auto drive = with_gains({2 * mass, 3 * mass, 0});
    drive->set_velocity(0.5, -0.2, 0);
    world.advance(kTime, step);
    EXPECT_NEAR(velocity().x(), 0.5 * (1 - std::exp(-2 * kTime)), 1e-9);
    EXPECT_NEAR(velocity().y(), -0.2 * (1 - std::exp(-3 * kTime)), 1e-9);
    world.devices().remove(*drive);
  }
}

/// w(t) = w (1 - exp(-k t / I)).
TEST_F(PlanarForces, TheRateOfTurnIsToo) {
  const double inertia = described.inertia()(2, 2);
  with_gains({0, 0, 4 * inertia})->set_velocity(0, 0, 0.6);
  world.advance(kTime, 0.005);
  EXPECT_NEAR(world.velocity(body).angular.z(), 0.6 * (1 - std::exp(-4 * kTime)), 1e-9);
}

TEST_F(PlanarForces, LargeGainsDoNotOvershoot) {
  with_gains({1e9, 1e9, 1e9})->set_velocity(0.5, 0, 0);
  world.advance(0.05, 0.05);
  EXPECT_NEAR(velocity().x(), 0.5, 1e-9);
}

/// gain * error is the other force, with any substep.
TEST_F(PlanarForces, AConstantForceLeavesItsError) {
  for (const double step : {0.05, 0.001}) {
    world.reset();
    const auto drive = with_gains({100, 100, 100});
    drive->set_velocity(0.5, 0, 0);
    for (int i = 0; i < 200; ++i) {
      world.wrenches().apply(body, {Vector3(3, -7, 0), Vector3(0, 0, 2)});
      world.advance(0.05, step);
    }
    const double turning = world.velocity(body).angular.z();
    const double yaw = to_rpy(world.pose(body).orientation).z();
    EXPECT_NEAR(turning, 2.0 / 100, 1e-6);
    EXPECT_NEAR(velocity().x(), 0.5 + (3 * std::cos(yaw) - 7 * std::sin(yaw)) / 100, 2e-3);
    world.devices().remove(*drive);
  }
}

TEST_F(PlanarForces, WithoutACommandTheyBrake) {
  with_gains({2 * described.mass, 2 * described.mass, 0});
  world.set_velocity(robot, {{1, 0, 0}, {}});
  world.advance(kTime, 0.005);
  EXPECT_NEAR(world.velocity(body).linear.x(), std::exp(-2 * kTime), 1e-9);
}

TEST_F(PlanarForces, InvalidNumbersAreRefused) {
  EXPECT_THROW(with_gains({-1, 0, 0}), InvalidInput);
  EXPECT_THROW(with_gains({0, kInfinity, 0}), InvalidInput);
  EXPECT_THROW(with_gains({0, 0, 0})->set_velocity(kNaN, 0, 0), InvalidInput);
  EXPECT_THROW(PlanarForceDrive(world, robot, {}), WrongObject);
}

}  // namespace
}  // namespace bubblesim::test::test_planar_force_drive
