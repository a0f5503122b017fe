// SPDX-License-Identifier: BSD-3-Clause
// Colours and textures that a mesh file brings.
#pragma once

#include <filesystem>
#include <vector>

#include "bubblesim/scene.hpp"

struct aiScene;

namespace bubblesim {

/// In the order of the file. A texture that cannot be found or read leaves its material's colour.
std::vector<Material> mesh_materials(const aiScene& scene, const std::filesystem::path& file);

}  // namespace bubblesim
