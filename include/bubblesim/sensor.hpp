// SPDX-License-Identifier: BSD-3-Clause
// What a sensor is. A sensor returns a struct; who shows or publishes it is not its business.
#pragma once

#include <memory>
#include <optional>

#include "bubblesim/scene.hpp"
#include "bubblesim/world.hpp"

namespace bubblesim {

/// What a sonar or another proximity sensor saw. Lengths in metres, in the sensor's frame (x is where it looks).
struct ProximityReading {
  bool detected = false;
  double distance = 0;
  Vector3 point;
  Vector3 normal;               ///< of the surface seen
  ObjectId object = kNoObject;  ///< the link seen
};

class Sensor {
 public:
  virtual ~Sensor() = default;
  /// Measures the world as it stands now.
  virtual void update(const World& world) = 0;
  /// The last measurement of a proximity sensor, nothing for sensors of other kinds.
  virtual std::optional<ProximityReading> proximity() const { return std::nullopt; }
};

/// Makes the sensor that a scene describes; `id` is its object in the world's tree.
std::unique_ptr<Sensor> make_sensor(const SensorDescription& description, ObjectId id, const World& world);

}  // namespace bubblesim
