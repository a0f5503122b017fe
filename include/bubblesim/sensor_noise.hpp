// SPDX-License-Identifier: BSD-3-Clause
// Random numbers of sensors. They depend only on the simulation's seed, the sensor and the time of the measurement, so
// a reading does not depend on other readings.
#pragma once

#include <array>
#include <cstdint>

#include "bubblesim/sensor.hpp"

namespace bubblesim {

/// Normally distributed random numbers from SplitMix64 (Steele, Lea, Flood 2014).
class NormalSource {
 public:
  explicit NormalSource(std::uint64_t state) : state_(state) {}
  /// N(0, 1), by Marsaglia's polar method.
  double next();

 private:
  double uniform();  // -1..1

  std::uint64_t state_;
  double spare_ = 0;
  bool has_spare_ = false;
};

/// Noise of the values of one measurement.
class Noise {
 public:
  /// `channel` distinguishes the noises of one sensor.
  Noise(const NoiseDescription& description, const MeasurementContext& context, ObjectId sensor,
        std::uint64_t channel = 0);

  /// False when values are not changed.
  bool active() const { return active_; }
  double operator()(double value);

 private:
  NoiseDescription description_;
  bool active_;
  double bias_ = 0;
  NormalSource normal_;
};

/// Adds noise to the single value of a measurement.
void distort(double& value, const NoiseDescription& description, const MeasurementContext& context, ObjectId sensor,
             std::uint64_t channel);
/// Likewise to the components of a vector, whose channels follow each other.
void distort(Vector3& value, const std::array<NoiseDescription, 3>& descriptions, const MeasurementContext& context,
             ObjectId sensor, std::uint64_t first_channel);

}  // namespace bubblesim
