// SPDX-License-Identifier: BSD-3-Clause
// Measurements in saved states.
#pragma once

#include "bubblesim/sensor.hpp"
#include "bubblesim/state_archive.hpp"

namespace bubblesim {

/// Saves or restores the values of a measurement, whose kind is known.
void transfer(StateArchive& archive, Measurement& measurement);

}  // namespace bubblesim
