// SPDX-License-Identifier: BSD-3-Clause
// Floating bodies: equilibrium by Archimedes, bobbing, righting, and fluids in layers.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "bubblesim/buoyancy.hpp"
#include "bubblesim/drag.hpp"
#include "bubblesim/error.hpp"
#include "bubblesim/simulation.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_buoyancy {
namespace {

constexpr double kWater = 1000;
constexpr double kGravity = 9.81;

/// The model "Body", in water below z = 0 and vacuum above.
class Floating : public ::testing::Test {
 protected:
  void make(const Geometry& geometry, double mass, const Pose& pose, std::vector<FluidLayer> layers = {{0, 0}}) {
    LinkDescription described = link_with(geometry);
    described.mass = mass;
    described.inertia_diagonal = Vector3::Ones() * (mass * 0.05);
    SceneDescription made = scene({model("Body", described, pose)});
    made.substep = 0.001;
    simulation = std::make_unique<Simulation>(made);
    device = std::make_shared<Buoyancy>(kWater, std::move(layers), std::vector<std::string>{});
    world().devices().add(device);
  }
  void slow_down(double linear, double angular) {
    DragDescription drag;
    drag.link = body();
    drag.linear = Vector3::Ones() * linear;
    drag.angular_linear = Vector3::Ones() * angular;
    world().devices().add(std::make_shared<Drag>(world(), drag, nullptr));
  }
  World& world() { return simulation->world(); }
  ObjectId body() { return world().tree().find("/Body/link"); }
  double height() { return world().pose(body()).position.z(); }
  void run(double seconds) {
    for (int i = 0; i < std::lround(seconds / simulation->time_step()); ++i) simulation->step();
  }

  std::unique_ptr<Simulation> simulation;
  std::shared_ptr<Buoyancy> device;
};

TEST_F(Floating, ABoxSinksUntilItDisplacesItsMass) {
  make(Box{{1, 1, 0.4}}, 150, at(0, 0, 0.3));  // 0.15 m deep
  slow_down(400, 400);
  run(20);
  EXPECT_NEAR(height(), 0.2 - 0.15, 1e-6);
}

TEST_F(Floating, ASphereSinksUntilItDisplacesItsMass) {
  const double r = 0.2;
  // A depth of 0.25 m: pi h^2 (3 r - h) / 3 * density
  make(Sphere{r}, kWater * M_PI * 0.0625 * (3 * r - 0.25) / 3, at(0, 0, 0.5));
  slow_down(80, 0);
  run(40);
  EXPECT_NEAR(height(), r - 0.25, 1e-6);
}

TEST_F(Floating, BobbingHasThePeriodOfItsWaterline) {
  make(Box{{1, 1, 0.4}}, 150, at(0, 0, 0.05 + 0.02));
  // 2 pi sqrt(m / (density g area)), without added mass
  const double period = 2 * M_PI * std::sqrt(150 / (kWater * kGravity));
  std::vector<double> crossings;
  double before = height();
  for (int i = 0; i < 8000; ++i) {
    world().advance(0.001, 0.001);
    const double now = height();
    if (before < 0.05 && now >= 0.05) crossings.push_back(0.001 * (i + (0.05 - before) / (now - before)));
    before = now;
  }
  ASSERT_GT(crossings.size(), 5U);
  const double found = (crossings.back() - crossings.front()) / static_cast<double>(crossings.size() - 1);
  EXPECT_NEAR(found, period, 1e-4 * period);
}

TEST_F(Floating, AFlatBoxRightsItself) {
  make(Box{{1, 1, 0.4}}, 150, Pose(0, 0, 0.1, 0.3, 0.2, 0));
  slow_down(400, 100);
  run(30);
  EXPECT_NEAR(to_rpy(world().pose(body()).orientation).x(), 0, 1e-5);
  EXPECT_NEAR(to_rpy(world().pose(body()).orientation).y(), 0, 1e-5);
}

TEST_F(Floating, ATallCylinderFallsOver) {
  make(Cylinder{0.2, 1}, 0.5 * kWater * M_PI * 0.04, Pose(0, 0, 0, 0.01, 0, 0));
  slow_down(100, 4);
  run(30);
  const Vector3 axis = world().pose(body()).orientation * Vector3::UnitZ();
  EXPECT_NEAR(axis.z(), 0, 1e-3);
  EXPECT_NEAR(height(), 0, 1e-4);
}

TEST_F(Floating, NeutralInOneFluidEverywhere) {
  make(Box{{1, 1, 1}}, kWater, at(0, 0, 500), {});
  run(5);
  EXPECT_NEAR(height(), 500, 1e-9);
}

TEST_F(Floating, RestsBetweenTwoFluids) {
  // Water below 0, oil of 800 kg/m^3 up to 2 m: 900 kg/m^3 is half in each.
  make(Box{{1, 1, 1}}, 900, at(0, 0, 0.2), {{0, 800}, {2, 0}});
  slow_down(1500, 1500);
  run(40);
  EXPECT_NEAR(height(), 0, 1e-4);
}

TEST_F(Floating, AVolumeReplacesTheShapes) {
  make(Box{{1, 1, 1}}, kWater * 0.25, at(0, 0, -10));
  device->set_volume(world(), body(), 0.25, {0, 0, 0});
  run(2);
  EXPECT_NEAR(height(), -10, 1e-9);
}

TEST_F(Floating, ActsOnlyOnItsModels) {
  SceneDescription made = scene({model("Duck", link_with(Box{{1, 1, 1}}), at(0, 0, -5)),
                                 model("Duckling", link_with(Box{{1, 1, 1}}), at(5, 0, -5))});
  Simulation pond(made);
  pond.world().devices().add(
      std::make_shared<Buoyancy>(kWater, std::vector<FluidLayer>{}, std::vector<std::string>{"/Duck"}));
  pond.step();
  EXPECT_GT(pond.world().velocity(pond.world().tree().find("/Duck")).linear.z(), 1);
  EXPECT_LT(pond.world().velocity(pond.world().tree().find("/Duckling")).linear.z(), 0);
}

TEST_F(Floating, InvalidParametersAreRefused) {
  EXPECT_THROW(Buoyancy(-1, {}, {}), InvalidInput);
  EXPECT_THROW(Buoyancy(1000, {{0, kNaN}}, {}), InvalidInput);
  EXPECT_THROW(Buoyancy(1000, {{kInfinity, 1}}, {}), InvalidInput);
  EXPECT_THROW(Buoyancy(1000, {{1, 1}, {0, 1}}, {}), InvalidInput);
  make(Box{{1, 1, 1}}, 1, at(0, 0, 0));
  EXPECT_THROW(device->set_volume(world(), body(), 0, {}), InvalidInput);
  EXPECT_THROW(device->set_volume(world(), world().tree().find("/Body"), 1, {}), WrongObject);
}

}  // namespace
}  // namespace bubblesim::test::test_buoyancy
