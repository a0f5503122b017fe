// SPDX-License-Identifier: BSD-3-Clause
// Random numbers of sensors. They follow from the simulation's seed, the sensor and the time of the measurement alone,
// so that a reading is the same whether or not others were taken before it.
#pragma once

#include <cstdint>

#include "bubblesim/sensor.hpp"

namespace bubblesim {

/// SplitMix64 (Steele, Lea, Flood 2014) as a source of normal numbers.
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
  /// `channel` tells apart several noises of one sensor.
  Noise(const NoiseDescription& description, const MeasurementContext& moment, ObjectId sensor,
        std::uint64_t channel = 0);

  /// False when values stay as they are.
  bool active() const { return active_; }
  double operator()(double value);

 private:
  NoiseDescription description_;
  bool active_;
  double bias_ = 0;
  NormalSource normal_;
};

/// Noise of a measurement's single value.
void distort(double& value, const NoiseDescription& description, const MeasurementContext& moment, ObjectId sensor,
             std::uint64_t channel);

}  // namespace bubblesim
