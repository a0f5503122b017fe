// SPDX-License-Identifier: BSD-3-Clause
// SDFormat's <sensor>.
#pragma once

#include <sdf/Sensor.hh>

#include "bubblesim/error.hpp"
#include "bubblesim/scene.hpp"
#include "sdf_source.hpp"

namespace bubblesim {

/// Reads what kind of sensor it is, and how it measures, into `description`, whose pose in the link is known already.
/// False when it cannot be told; the reason is reported.
bool read_sensor_kind(const sdf::Sensor& sensor, SensorDescription& description, const Report& report);

}  // namespace bubblesim
