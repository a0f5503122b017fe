// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>

#include "meshes/mesh_content.hpp"

struct aiScene;

namespace bubblesim {

/// Merges the parts of a file into one mesh, without materials. `names` receives the names of all parts.
TriangleMesh gather(const aiScene& scene, const MeshQuery& query, std::set<std::string>& names);

}  // namespace bubblesim
