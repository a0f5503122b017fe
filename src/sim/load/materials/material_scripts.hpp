// SPDX-License-Identifier: BSD-3-Clause
// Reads colour and texture from OGRE material scripts, which are part of Gazebo models.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bubblesim/scene.hpp"

namespace bubblesim {

/// Returns the material of that name in scripts (*.material) that are in `places` or in folders there. Its texture is
/// searched in these folders and in `textures` next to them. Only the first pass and its first texture are used.
std::optional<Material> script_material(const std::string& name, const std::vector<std::filesystem::path>& places);

}  // namespace bubblesim
