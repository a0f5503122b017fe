// SPDX-License-Identifier: BSD-3-Clause
// Linear and quadratic drag, compared with the solutions of the equation of motion.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "bubblesim/drag.hpp"
#include "bubblesim/error.hpp"
#include "bubblesim/simulation.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_drag {
namespace {

constexpr double kGravity = 9.81;
constexpr double kMass = 2;

class Falling : public ::testing::Test {
 protected:
  void make(DragDescription drag, const Vector3& gravity, const Vector3& wind = {}) {
    ModelDescription body = model("Body", link("link"), Pose(0, 0, 0, 0, 0, M_PI / 2));
    body.links[0].mass = kMass;
    body.links[0].inertia_diagonal = {1, 2, 4};
    SceneDescription described = scene({body}, gravity);
    described.environment.wind = wind;
    simulation = std::make_unique<Simulation>(described);
    drag.link = link_id();
    device = std::make_shared<Drag>(simulation->world(), drag, simulation->wind());
    simulation->world().devices().add(device);
  }
  ObjectId link_id() { return simulation->world().tree().find("/Body/link"); }
  Twist velocity() { return simulation->world().velocity(link_id()); }
  void set_velocity(const Twist& twist) { simulation->world().set_velocity(link_id(), twist); }
  void run(double seconds) {
    for (int i = 0; i < std::lround(seconds / 0.05); ++i) simulation->step();
  }

  std::unique_ptr<Simulation> simulation;
  std::shared_ptr<Drag> device;
};

TEST_F(Falling, ReachesTheTerminalVelocityOfQuadraticDrag) {
  DragDescription drag;
  drag.quadratic = Vector3::Ones() * 0.5;
  make(drag, {0, 0, -kGravity});
  run(20);
  EXPECT_NEAR(velocity().linear.z(), -std::sqrt(kMass * kGravity / 0.5), 1e-9);
}

TEST_F(Falling, ApproachesItAsTheHyperbolicTangent) {
  DragDescription drag;
  drag.quadratic = Vector3::Ones() * 0.5;
  make(drag, {0, 0, -kGravity});
  run(1);
  const double terminal = std::sqrt(kMass * kGravity / 0.5);
  EXPECT_NEAR(velocity().linear.z(), -terminal * std::tanh(kGravity / terminal), 2e-3 * terminal);
}

TEST_F(Falling, LinearDragDecaysExponentially) {
  DragDescription drag;
  drag.linear = Vector3::Ones() * kMass;
  drag.angular_linear = {0.5, 1, 2};
  make(drag, Vector3::Zero());
  set_velocity({{3, 0, 1}, {0, 0, 2}});
  run(1);
  EXPECT_NEAR(velocity().linear.x(), 3 * std::exp(-1), 3 * 0.003);  // Euler's method: 1 s * (1/s)^2 * step / 2
  EXPECT_NEAR(velocity().linear.z(), std::exp(-1), 0.003);
  EXPECT_NEAR(velocity().angular.z(), 2 * std::exp(-0.5), 2 * 0.001);
}

TEST_F(Falling, CoefficientsAreThoseOfTheAxesOfTheLink) {
  DragDescription drag;
  drag.linear = {kMass, 0, 0};
  make(drag, Vector3::Zero());  // turned by 90 degrees: its x is the world's y
  set_velocity({{1, 1, 0}, {}});
  run(1);
  EXPECT_NEAR(velocity().linear.x(), 1, 1e-12);
  EXPECT_NEAR(velocity().linear.y(), std::exp(-1), 1e-3);
}

TEST_F(Falling, FluidCarriesItAlong) {
  DragDescription drag;
  drag.linear = Vector3::Ones() * 20;
  drag.in_wind = true;
  make(drag, Vector3::Zero(), {4, 0, 0});
  device->set_current({0, 1, 0});
  run(5);
  EXPECT_NEAR(velocity().linear.x(), 4, 1e-6);
  EXPECT_NEAR(velocity().linear.y(), 1, 1e-6);
}

TEST_F(Falling, GreatCoefficientsStopItWithoutReversingIt) {
  DragDescription drag;
  drag.linear = Vector3::Ones() * 1e8;
  drag.angular_quadratic = Vector3::Ones() * 1e8;
  make(drag, Vector3::Zero());
  set_velocity({{1, 2, 3}, {0, 0, 1}});
  run(0.05);
  EXPECT_NEAR(velocity().linear.norm(), 0, 1e-9);
  EXPECT_NEAR(velocity().angular.norm(), 0, 1e-9);
}

TEST_F(Falling, InvalidParametersAreRefused) {
  make({}, Vector3::Zero());
  DragDescription drag;
  drag.link = link_id();
  drag.linear = {0, -1, 0};
  EXPECT_THROW(Drag(simulation->world(), drag, nullptr), InvalidInput);
  drag.linear = {0, kNaN, 0};
  EXPECT_THROW(Drag(simulation->world(), drag, nullptr), InvalidInput);
  EXPECT_THROW(device->set_current({kInfinity, 0, 0}), InvalidInput);
  drag = {};
  drag.link = simulation->world().tree().find("/Body");
  EXPECT_THROW(Drag(simulation->world(), drag, nullptr), WrongObject);
}

}  // namespace
}  // namespace bubblesim::test::test_drag
