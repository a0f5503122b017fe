// SPDX-License-Identifier: BSD-3-Clause
// Sensors and their measurements. A sensor returns a struct; publishing is done elsewhere. SI units; sensors look along
// their x axis, y to the left, z up.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <variant>
#include <vector>

#include "bubblesim/math.hpp"
#include "bubblesim/scene.hpp"
#include "bubblesim/scene_tree.hpp"
#include "bubblesim/world.hpp"

namespace bubblesim {

class RayScene;

struct Reading {
  double time = 0;  ///< s, Simulation::state_time() of the measurement: the time of the state that it shows
  Measurement measurement;
};

/// Inputs of a measurement.
struct MeasurementContext {
  const World& world;
  RayScene& rays;
  double time = 0;         ///< s, of the state of `world`
  std::uint64_t seed = 0;  ///< of the simulation; noise depends on it, the sensor and the time only
  double noise_scale = 1;  ///< factor of the standard deviations of the sensor's noise
  double brightness = 1;   ///< factor of all lights
};

class Sensor {
 public:
  virtual ~Sensor() = default;

  void update(const MeasurementContext& context);
  /// Rays of a measurement: those with rays may measure in several threads at once, after RayScene::refresh().
  virtual std::size_t ray_count() const { return 0; }
  /// Forgets the last measurement.
  void reset();
  /// Replaces the last measurement.
  void replace(double time, Measurement measurement);
  /// Saves or restores the last measurement.
  void transfer(StateArchive& archive);
  /// The last measurement. It does not change while a caller holds it; the next one is written to another buffer.
  std::shared_ptr<const Reading> reading() const { return reading_; }

 protected:
  /// `empty` determines the kind of measurement.
  explicit Sensor(Measurement empty);

 private:
  /// Measures into `measurement`, which holds an earlier measurement of the same kind.
  virtual void measure(const MeasurementContext& context, Measurement& measurement) = 0;

  Measurement empty_;
  std::shared_ptr<Reading> reading_;
};

/// Creates the sensor of a description; `id` is its object in the world's tree.
std::unique_ptr<Sensor> make_sensor(const SensorDescription& description, const Environment& environment, ObjectId id,
                                    const World& world);

}  // namespace bubblesim
