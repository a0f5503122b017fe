// SPDX-License-Identifier: BSD-3-Clause
// Colours and textures of a mesh file.
#pragma once

#include <filesystem>
#include <vector>

#include "meshes/mesh_content.hpp"

namespace bubblesim {

/// The materials in the order of the file; empty when the file has neither colours nor textures. If a texture cannot be
/// found or read, its material's colour is used.
std::vector<Material> mesh_materials(const std::vector<FileMaterial>& materials, const std::filesystem::path& file);

}  // namespace bubblesim
