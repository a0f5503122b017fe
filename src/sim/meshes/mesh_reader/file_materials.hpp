// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "meshes/mesh_content.hpp"

struct aiScene;

namespace bubblesim {

/// The materials in the order of the file.
std::vector<FileMaterial> file_materials(const aiScene& scene);

}  // namespace bubblesim
