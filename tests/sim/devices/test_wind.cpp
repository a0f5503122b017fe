// SPDX-License-Identifier: BSD-3-Clause
// The wind: its force on links, and its variation.
#include <gtest/gtest.h>

#include <cmath>

#include "bubblesim/error.hpp"
#include "bubblesim/simulation.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_wind {
namespace {

constexpr double kStep = 0.005;

/// A link that the wind pushes, and one that it does not.
SceneDescription leaf(const Vector3& wind) {
  LinkDescription light = link("link");
  light.wind_enabled = true;
  light.mass = 3;
  SceneDescription made = scene({model("Leaf", light), model("Stone", link("link"))}, Vector3::Zero());
  made.substep = kStep;
  made.environment.wind = wind;
  return made;
}

class Blown : public ::testing::Test {
 protected:
  void run(double seconds) {
    for (int i = 0; i < std::lround(seconds / simulation.time_step()); ++i) simulation.step();
  }
  Vector3 velocity_of(const std::string& path) {
    return simulation.world().velocity(simulation.world().tree().find(path)).linear;
  }

  Simulation simulation{leaf({2, 0, 0}), 7};
};

TEST_F(Blown, DriftsTowardsTheVelocityOfTheWind) {
  run(1);
  // v' = factor (wind - v); Euler's method is (1 - factor step)^n instead of exp(-factor t).
  EXPECT_NEAR(velocity_of("/Leaf/link").x(), 2 * (1 - std::pow(1 - kStep, 200)), 1e-9);
  EXPECT_NEAR(velocity_of("/Leaf/link").x(), 2 * (1 - std::exp(-1)), 2e-3);
  EXPECT_EQ(velocity_of("/Stone/link").x(), 0);
}

TEST_F(Blown, ForceFactorIsTheRate) {
  simulation.wind()->set_force_factor(0.1);
  run(1);
  EXPECT_NEAR(velocity_of("/Leaf/link").x(), 2 * (1 - std::exp(-0.1)), 1e-4);
  simulation.wind()->set_force_factor(1e6);
  run(0.05);
  EXPECT_NEAR(velocity_of("/Leaf/link").x(), 2, 1e-9) << "it is not thrown beyond";
}

TEST_F(Blown, StillAirSlowsOnlyWhereTheWindVaries) {
  Simulation still(leaf({}), 0);
  const ObjectId link = still.world().tree().find("/Leaf/link");
  still.world().set_velocity(link, {{1, 0, 0}, {}});
  still.step();
  EXPECT_EQ(still.world().velocity(link).linear.x(), 1);
  still.wind()->set_variation({});
  still.step();
  EXPECT_LT(still.world().velocity(link).linear.x(), 0.99);
}

TEST_F(Blown, PushesModelsThatAreAddedLater) {
  run(0.1);
  ModelDescription other = leaf({}).models[0];
  other.name = "Other";
  simulation.add_model(other);
  run(1);
  EXPECT_NEAR(velocity_of("/Other/link").x(), 2 * (1 - std::exp(-1)), 2e-3);
}

TEST_F(Blown, RisesWithItsTimeConstant) {
  Wind::Variation variation;
  variation.rise_time = 0.5;
  variation.vertical_rise_time = 2;
  simulation.wind()->set_variation(variation);
  simulation.wind()->set_mean({0, 3, 1});
  run(1);
  const Vector3 wind = simulation.wind()->velocity();
  EXPECT_NEAR(wind.z(), 1 - std::exp(-0.5), 1e-9);
  EXPECT_NEAR(std::hypot(wind.x(), wind.y()), 3 * (1 - std::exp(-2)), 1e-9);
  EXPECT_NEAR(std::atan2(wind.x(), wind.y()), M_PI / 2 * std::exp(-1), 1e-9) << "it turns within 1 s";
}

TEST_F(Blown, SineIsAddedToSpeedAndDirection) {
  Wind::Variation variation;
  variation.rise_time = variation.turn_time = 1e-9;
  variation.sine_part = 0.5;
  variation.sine_period = 4;
  variation.turn_sine = 0.3;
  variation.turn_period = 4;
  simulation.wind()->set_variation(variation);
  run(1.05);  // the last substep begins at 1.045 s
  const Vector3 wind = simulation.wind()->velocity();
  const double sine = std::sin(2 * M_PI * 1.045 / 4);
  EXPECT_NEAR(std::hypot(wind.x(), wind.y()), 2 * (1 + 0.5 * sine), 1e-9);
  EXPECT_NEAR(std::atan2(wind.y(), wind.x()), 0.3 * sine, 1e-9);
}

TEST_F(Blown, NoiseHasItsDeviationAndDependsOnTheSeed) {
  Wind::Variation variation;
  variation.rise_time = 1e-9;
  variation.speed_noise = 0.2;
  Simulation same(leaf({2, 0, 0}), 7);
  Simulation other(leaf({2, 0, 0}), 8);
  for (Simulation* each : {&simulation, &same, &other}) each->wind()->set_variation(variation);
  double sum = 0;
  double squares = 0;
  constexpr int kCount = 2000;
  for (int i = 0; i < kCount; ++i) {
    simulation.step();
    same.step();
    const double gust = simulation.wind()->velocity().x() - 2;
    sum += gust;
    squares += gust * gust;
  }
  other.step();
  EXPECT_NEAR(sum / kCount, 0, 4 * 0.2 / std::sqrt(kCount));
  EXPECT_NEAR(std::sqrt(squares / kCount), 0.2, 0.02);
  EXPECT_EQ(simulation.state_hash(), same.state_hash());
  EXPECT_NE(simulation.wind()->velocity(), other.wind()->velocity());
}

TEST_F(Blown, ResetsToTheWindOfTheScene) {
  run(0.05);
  simulation.reset();
  const std::uint64_t fresh = simulation.state_hash();
  simulation.wind()->set_mean({9, 9, 9});
  run(1);
  simulation.reset();
  EXPECT_EQ(simulation.wind()->velocity(), Vector3(2, 0, 0));
  EXPECT_EQ(simulation.state_hash(), fresh);
}

TEST_F(Blown, InvalidValuesAreRefused) {
  Wind& wind = *simulation.wind();
  EXPECT_THROW(wind.set_mean({kNaN, 0, 0}), InvalidInput);
  EXPECT_THROW(wind.set_force_factor(-1), InvalidInput);
  Wind::Variation variation;
  variation.rise_time = 0;
  EXPECT_THROW(wind.set_variation(variation), InvalidInput);
  variation = {};
  variation.turn_noise = -1;
  EXPECT_THROW(wind.set_variation(variation), InvalidInput);
}

}  // namespace
}  // namespace bubblesim::test::test_wind
