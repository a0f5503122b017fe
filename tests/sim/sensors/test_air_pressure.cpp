// SPDX-License-Identifier: BSD-3-Clause
// Air pressure compared with the tables of the U.S. Standard Atmosphere, 1976.
#include <gtest/gtest.h>

#include "bubblesim/simulation.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_air_pressure {
namespace {

double pressure_at(double height, double reference, double bias = 0) {
  AirPressureDescription description;
  description.reference_altitude = reference;
  description.pressure_noise.mean = bias;
  Simulation simulation(with_sensor("Barometer", description, {}, at(0, 0, height)), 0);
  const ObjectId sensor = simulation.world().tree().find("/Barometer");
  return simulation.measure(sensor)->measurement.get<AirPressureReading>().pressure;
}

TEST(AirPressure, IsThatOfTheStandardAtmosphere) {
  EXPECT_NEAR(pressure_at(0, 0), 101325, 0.1);
  EXPECT_NEAR(pressure_at(1000, 0), 89876, 3);
  EXPECT_NEAR(pressure_at(-500, 0), 107478, 3);
  EXPECT_NEAR(pressure_at(10000, 0), 26500, 3);
}

TEST(AirPressure, CountsFromTheReferenceAltitude) { EXPECT_EQ(pressure_at(200, 800), pressure_at(1000, 0)); }

TEST(AirPressure, IsAsNoisyAsItsFileStates) { EXPECT_NEAR(pressure_at(0, 0, 25), 101350, 0.1); }

}  // namespace
}  // namespace bubblesim::test::test_air_pressure
