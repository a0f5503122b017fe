// SPDX-License-Identifier: BSD-3-Clause
// Lift and drag of a wing over its angle of attack, before and after the stall.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "bubblesim/error.hpp"
#include "bubblesim/lift_drag.hpp"
#include "bubblesim/simulation.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_lift_drag {
namespace {

constexpr double kSpeed = 20;  // m/s
constexpr double kMass = 1000;

struct Coefficients {
  double lift;
  double drag;
};

class Wing : public ::testing::Test {
 protected:
  Wing() {
    wing.area = 0.5;
    wing.density = 1.2;
    wing.lift_slope = 5;
    wing.drag_slope = 0.3;
    wing.alpha_stall = 0.3;
    wing.lift_slope_stall = -3;
    wing.drag_slope_stall = 2;
  }

  /// Flies along the world's x, pitched up by the angle of attack and yawed by the sweep, and returns the acceleration
  /// in terms of the coefficients: the lift along z, the drag against x.
  Coefficients fly(double alpha, double sweep = 0, const Vector3& wind = {}) {
    ModelDescription body = model("Wing", link("link"), Pose(0, 0, 0, 0, -alpha, sweep));
    body.links[0].mass = kMass;
    body.links[0].inertia_diagonal = Vector3::Ones() * 1e6;
    SceneDescription described = scene({body}, Vector3::Zero());
    described.environment.wind = wind;
    Simulation simulation(described);
    World& world = simulation.world();
    wing.link = world.tree().find("/Wing/link");
    world.devices().add(std::make_shared<LiftDrag>(world, wing, simulation.wind()));
    world.set_velocity(wing.link, {{kSpeed + wind.x(), wind.y(), wind.z()}, {}});
    world.advance(0.001, 0.001);
    const Vector3 change = world.velocity(wing.link).linear - Vector3(kSpeed, 0, 0) - wind;
    const double pressure = 0.5 * wing.density * kSpeed * kSpeed * wing.area;
    return {change.z() * kMass / 0.001 / pressure, -change.x() * kMass / 0.001 / pressure};
  }

  LiftDragDescription wing;
};

TEST_F(Wing, CoefficientsAreProportionalToTheAngleOfAttackBeforeTheStall) {
  for (const double alpha : {-0.25, -0.1, 0.0, 0.05, 0.2, 0.29}) {
    const auto [lift, drag] = fly(alpha);
    EXPECT_NEAR(lift, 5 * alpha, 1e-6) << alpha;
    EXPECT_NEAR(drag, std::abs(0.3 * alpha), 1e-6) << alpha;
  }
}

TEST_F(Wing, SlopesChangeBeyondTheStall) {
  for (const double alpha : {0.4, 0.6, -0.5}) {
    const double beyond = std::abs(alpha) - 0.3;
    const auto [lift, drag] = fly(alpha);
    EXPECT_NEAR(lift, std::copysign(5 * 0.3 - 3 * beyond, alpha), 1e-6) << alpha;
    EXPECT_NEAR(drag, 0.3 * 0.3 + 2 * beyond, 1e-6) << alpha;
  }
}

TEST_F(Wing, LiftDoesNotChangeItsSignBeyondTheStall) {
  EXPECT_NEAR(fly(1.2).lift, 0, 1e-9);
  EXPECT_NEAR(fly(-1.2).lift, 0, 1e-9);
}

TEST_F(Wing, HasAnAngleOfAttackInLevelFlight) {
  wing.alpha0 = 0.1;
  EXPECT_NEAR(fly(0).lift, 0.5, 1e-6);
  EXPECT_NEAR(fly(0.05).lift, 0.75, 1e-6);
}

TEST_F(Wing, SweepReducesTheCoefficientsByItsSquaredCosine) {
  wing.alpha0 = 0.1;
  // The pressure has the squared cosine too: only the velocity in the plane counts.
  EXPECT_NEAR(fly(0, 0.4).lift, 0.5 * std::pow(std::cos(0.4), 4), 1e-6);
}

TEST_F(Wing, VelocityIsRelativeToTheWind) {
  EXPECT_NEAR(fly(0.1, 0, {-7, 0, 0}).lift, fly(0.1).lift, 1e-6);
  EXPECT_NEAR(fly(0.1, 0, {-7, 3, 1}).drag, fly(0.1).drag, 1e-6);
}

TEST_F(Wing, ABodyOfRevolutionLiftsInAnyDirection) {
  wing.radial_symmetry = true;
  wing.upward = Vector3::UnitY();
  const auto [lift, drag] = fly(0.1);
  EXPECT_NEAR(lift, 0.5, 1e-6);
  EXPECT_NEAR(drag, 0.03, 1e-6);
}

TEST_F(Wing, AForceBesideTheCentreOfMassTurnsIt) {
  ModelDescription body = model("Wing", link("link"), Pose(0, 0, 0, 0, -0.1, 0));
  Simulation simulation(scene({body}, Vector3::Zero()));
  World& world = simulation.world();
  wing.link = world.tree().find("/Wing/link");
  wing.centre_of_pressure = {-0.5, 0, 0};
  wing.drag_slope = 0;
  world.devices().add(std::make_shared<LiftDrag>(world, wing, nullptr));
  world.set_velocity(wing.link, {{kSpeed, 0, 0}, {}});
  world.advance(0.001, 0.001);
  const double lift = 0.5 * 0.5 * 1.2 * kSpeed * kSpeed * 0.5;
  EXPECT_NEAR(world.velocity(wing.link).angular.y(), 0.001 * lift * 0.5 * std::cos(0.1), 1e-6);
}

TEST_F(Wing, AFlapAddsToTheLift) {
  ModelDescription body = model("Wing", link("base"));
  body.links.push_back(link("arm", {-0.5, 0, 0}));
  for (LinkDescription& each : body.links) each.mass = kMass;
  body.joints.push_back(joint("revolute", {axis(Vector3::UnitY())}, {-0.5, 0, 0}));
  Simulation simulation(scene({body}, Vector3::Zero()));
  World& world = simulation.world();
  wing.link = world.tree().find("/Wing/base");
  wing.control_joint = world.tree().find("/Wing/joint");
  wing.control_slope = 2;
  world.devices().add(std::make_shared<LiftDrag>(world, wing, nullptr));
  world.joints().set_position(wing.control_joint, 0.2);
  world.set_velocity(world.tree().find("/Wing"), {{kSpeed, 0, 0}, {}});
  world.advance(0.001, 0.001);
  const double momentum =
      kMass * (world.velocity(wing.link).linear.z() + world.velocity(world.tree().find("/Wing/arm")).linear.z());
  EXPECT_NEAR(momentum / 0.001, 2 * 0.2 * 0.5 * 1.2 * kSpeed * kSpeed * 0.5, 0.05);
}

TEST_F(Wing, InvalidParametersAreRefused) {
  Simulation simulation(scene({model("Wing", link("link"))}));
  wing.link = simulation.world().tree().find("/Wing/link");
  const auto refuses = [&](auto&& change) {
    LiftDragDescription changed = wing;
    change(changed);
    EXPECT_THROW(LiftDrag(simulation.world(), changed, nullptr), InvalidInput);
  };
  refuses([](LiftDragDescription& w) { w.area = -1; });
  refuses([](LiftDragDescription& w) { w.alpha_stall = -0.1; });
  refuses([](LiftDragDescription& w) { w.lift_slope = kNaN; });
  refuses([](LiftDragDescription& w) { w.upward = w.forward; });
  refuses([](LiftDragDescription& w) { w.forward = Vector3::Zero(); });
}

}  // namespace
}  // namespace bubblesim::test::test_lift_drag
