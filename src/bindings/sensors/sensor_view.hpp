// SPDX-License-Identifier: BSD-3-Clause
// The parameters of a sensor as a dictionary, in SI units.
#pragma once

#include <pybind11/pybind11.h>

#include "bubblesim/sensor_kinds.hpp"

namespace bubblesim::bindings {

/// `kind`: SensorDefinition::id, or depth_camera; the others are the numbers and choices among the members of the
/// description, under their names.
pybind11::dict sensor_parameters(const SensorKind& kind);

}  // namespace bubblesim::bindings
