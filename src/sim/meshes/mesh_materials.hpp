// SPDX-License-Identifier: BSD-3-Clause
// Colours and textures that a mesh file brings.
#pragma once

#include <filesystem>
#include <vector>

#include "meshes/mesh_content.hpp"

namespace bubblesim {

/// In the order of the file; none when it has neither a colour nor a texture. A texture that cannot be found or read
/// leaves its material's colour.
std::vector<Material> mesh_materials(const std::vector<FileMaterial>& materials, const std::filesystem::path& file);

}  // namespace bubblesim
