// SPDX-License-Identifier: BSD-3-Clause
// OGRE's material scripts, as far as a colour and a picture go: models for Gazebo bring them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bubblesim/scene.hpp"

namespace bubblesim {

/// The material of that name in scripts (*.material) that are among `places` or lie in folders there. Its texture is
/// looked for in these folders and in `textures` beside them. Only the first pass and its first texture count.
std::optional<Material> script_material(const std::string& name, const std::vector<std::filesystem::path>& places);

}  // namespace bubblesim
