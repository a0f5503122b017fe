// SPDX-License-Identifier: BSD-3-Clause
// The colours of names such as Gazebo/Red, which models use without the scripts that define them.
#pragma once

#include <optional>
#include <string>

#include "bubblesim/scene.hpp"

namespace bubblesim {

std::optional<Material> named_material(const std::string& name);

}  // namespace bubblesim
