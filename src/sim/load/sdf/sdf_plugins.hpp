// SPDX-License-Identifier: BSD-3-Clause
// SDFormat's <plugin>.
#pragma once

#include <sdf/Element.hh>
#include <vector>

#include "bubblesim/scene.hpp"

namespace bubblesim {

/// The plugins of a world, model or sensor.
std::vector<PluginDescription> read_plugins(const sdf::ElementPtr& owner);

}  // namespace bubblesim
