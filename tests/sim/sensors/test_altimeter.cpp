// SPDX-License-Identifier: BSD-3-Clause
// Altimeters and magnetometers.
#include <gtest/gtest.h>

#include "bubblesim/simulation.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_altimeter {
namespace {

template <class Kind>
SceneDescription carried(const Kind& kind, const Pose& pose) {
  SensorDescription sensor;
  sensor.name = "Sensor";
  sensor.kind = kind;
  ModelDescription robot = model("Robot", link("link"), pose);
  robot.links[0].sensors.push_back(sensor);
  return scene({robot}, Vector3::Zero());
}

template <class Kind>
Kind measured(Simulation& simulation) {
  return simulation.measure(simulation.world().tree().find("/Sensor"))->measurement.get<Kind>();
}

TEST(Altimeter, MeasuresTheHeightAboveItsStartAndHowFastItClimbs) {
  Simulation simulation(carried(AltimeterDescription{}, at(0, 0, 5)));
  EXPECT_EQ(measured<AltimeterReading>(simulation).height, 0);
  simulation.world().set_velocity(simulation.world().tree().find("/Robot"), {{3, 0, 2}, {}});
  for (int i = 0; i < 10; ++i) simulation.step();
  const auto reading = measured<AltimeterReading>(simulation);
  EXPECT_NEAR(reading.height, 2 * simulation.time(), 1e-9);
  EXPECT_NEAR(reading.velocity, 2, 1e-9);
}

TEST(Altimeter, IsAsNoisyAsItsFileStates) {
  AltimeterDescription noisy;
  noisy.position_noise.mean = 0.5;
  noisy.velocity_noise.mean = 0.25;
  Simulation simulation(carried(noisy, {}));
  const auto reading = measured<AltimeterReading>(simulation);
  EXPECT_EQ(reading.height, 0.5);
  EXPECT_EQ(reading.velocity, 0.25);
}

TEST(Magnetometer, MeasuresTheFieldOfTheWorldInItsOwnAxes) {
  SceneDescription described = carried(MagnetometerDescription{}, Pose(0, 0, 0, 0, 0, M_PI / 2));
  described.environment.magnetic_field = {2e-5, 1e-5, -4e-5};
  Simulation simulation(described);
  EXPECT_LT((measured<MagnetometerReading>(simulation).field - Vector3(1e-5, -2e-5, -4e-5)).norm(), 1e-12);
}

}  // namespace
}  // namespace bubblesim::test::test_altimeter
