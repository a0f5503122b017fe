// SPDX-License-Identifier: BSD-3-Clause
// SDFormat's <sensor>.
#pragma once

#include <optional>
#include <sdf/Sensor.hh>
#include <string>
#include <vector>

#include "bubblesim/scene.hpp"
#include "load/load_context.hpp"

namespace bubblesim {

/// Reads a sensor of the link or joint at a path; its pose is relative to that. Empty when its kind is unknown, which
/// is reported, or not simulated, which is a warning.
std::optional<SensorDescription> read_sensor(const sdf::Sensor& sensor, const std::string& carrier_path,
                                             const Pose& pose, LoadContext& reading);

/// The cameras of a sensor of type multicamera, each a sensor named SENSOR_CAMERA.
std::vector<SensorDescription> read_multicamera(const sdf::Sensor& sensor, const std::string& carrier_path,
                                                const Pose& pose, LoadContext& reading);

}  // namespace bubblesim
