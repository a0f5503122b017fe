// SPDX-License-Identifier: BSD-3-Clause
// SDFormat's <plugin>.
#pragma once

#include <vector>

#include "bubblesim/scene.hpp"
#include "load/sdf/elements/sdf_element.hpp"

namespace bubblesim {

/// The plugins of a world, model or sensor.
std::vector<PluginDescription> read_plugins(const SdfElement& owner);

}  // namespace bubblesim
