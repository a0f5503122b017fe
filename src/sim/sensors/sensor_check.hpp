// SPDX-License-Identifier: BSD-3-Clause
// Whether a sensor can be what its description says.
#pragma once

#include <functional>
#include <string>

#include "bubblesim/scene.hpp"

namespace bubblesim {

/// Reports that `what` is `found` and must be `wanted`, unless it is fine.
using Require =
    std::function<void(bool fine, const std::string& what, const std::string& found, const std::string& wanted)>;

/// Checks everything but the sensor's pose and what it is fixed to.
void check_sensor(const SensorDescription& sensor, const Require& require);

}  // namespace bubblesim
