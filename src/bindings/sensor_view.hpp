// SPDX-License-Identifier: BSD-3-Clause
// The parameters of a sensor as a dictionary, in SI units.
#pragma once

#include <pybind11/pybind11.h>

#include "bubblesim/sensor_kinds.hpp"

namespace bubblesim::bindings {

/// `kind` is that of sim's readings: proximity, lidar, camera, depth_camera, imu, navsat, altimeter, magnetometer,
/// contact or force_torque.
pybind11::dict sensor_parameters(const SensorKind& kind);

}  // namespace bubblesim::bindings
