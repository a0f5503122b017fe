// SPDX-License-Identifier: BSD-3-Clause
// SDFormat's <sensor>.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bubblesim/scene.hpp"
#include "load/load_context.hpp"
#include "load/sdf/elements/sdf_element.hpp"

namespace bubblesim {

/// Reads a sensor of the link or joint at a path, under a name that may differ from that of its element; its pose is
/// relative to the link or joint. Empty when its kind is unknown, which is reported, or not simulated, which is a
/// warning.
std::optional<SensorDescription> read_sensor(const SdfElement& sensor, const std::string& name,
                                             const std::string& carrier_path, const Pose& pose, LoadContext& context);

/// Whether it is of type multicamera: several cameras, which are sensors of their own.
bool is_multicamera(const SdfElement& sensor);

/// The cameras of such a sensor, each named SENSOR_CAMERA.
std::vector<SensorDescription> read_multicamera(const SdfElement& sensor, const std::string& name,
                                                const std::string& carrier_path, const Pose& pose,
                                                LoadContext& context);

}  // namespace bubblesim
