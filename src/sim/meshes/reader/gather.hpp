// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>

#include "meshes/mesh_content.hpp"

struct aiScene;

namespace bubblesim {

/// The parts of a file as one surface, without materials. `names` takes those of all parts.
TriangleMesh gather(const aiScene& scene, const MeshQuery& query, std::set<std::string>& names);

}  // namespace bubblesim
