// SPDX-License-Identifier: BSD-3-Clause
// The exponential decay of velocities, at different physics substeps.
#include <gtest/gtest.h>

#include <cmath>

#include "bubblesim/simulation.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_velocity_decay {
namespace {

SceneDescription slowed(double substep, double linear, double angular) {
  LinkDescription described = link("link");
  described.linear_decay = linear;
  described.angular_decay = angular;
  described.inertia_diagonal = {1, 2, 2.5};
  described.inertia_products = {0.1, 0.2, 0.3};
  described.centre_of_mass = {0.1, 0, 0};
  SceneDescription made = scene({model("Body", described)}, Vector3::Zero());
  made.substep = substep;
  return made;
}

TEST(VelocityDecay, IsExponentialAtAnySubstep) {
  for (const double substep : {0.001, 0.005, 0.025}) {
    Simulation simulation(slowed(substep, 2, 0));
    const ObjectId body = simulation.world().tree().find("/Body/link");
    simulation.world().set_velocity(body, {{3, -1, 0.5}, {}});
    for (int i = 0; i < 20; ++i) simulation.step();
    const Vector3 left = Vector3(3, -1, 0.5) * std::exp(-2);
    EXPECT_LT((simulation.world().velocity(body).linear - left).norm(), 1e-9) << substep;
  }
}

TEST(VelocityDecay, SlowsRotation) {
  SceneDescription described = slowed(0.001, 0, 2);
  described.models[0].links[0].inertia_diagonal = Vector3::Ones();  // of a ball: no gyroscopic torque
  described.models[0].links[0].inertia_products = Vector3::Zero();
  described.models[0].links[0].centre_of_mass = Vector3::Zero();
  Simulation simulation(described);
  const ObjectId body = simulation.world().tree().find("/Body/link");
  simulation.world().set_velocity(body, {{}, {1, 2, 3}});
  for (int i = 0; i < 20; ++i) simulation.step();
  EXPECT_LT((simulation.world().velocity(body).angular - Vector3(1, 2, 3) * std::exp(-2)).norm(), 1e-6);
}

TEST(VelocityDecay, InfiniteRateStops) {
  Simulation simulation(slowed(0.005, kInfinity, kInfinity));
  const ObjectId body = simulation.world().tree().find("/Body/link");
  simulation.world().set_velocity(body, {{1, 2, 3}, {}});
  simulation.step();
  EXPECT_NEAR(simulation.world().velocity(body).linear.norm(), 0, 1e-12);
}

}  // namespace
}  // namespace bubblesim::test::test_velocity_decay
