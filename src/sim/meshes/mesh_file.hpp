// SPDX-License-Identifier: BSD-3-Clause
// Loads mesh files: COLLADA, STL, OBJ and other formats of assimp.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "bubblesim/triangle_mesh.hpp"
#include "meshes/mesh_reader.hpp"

namespace bubblesim {

struct MeshRequest {
  std::filesystem::path file{};
  Vector3 scale = Vector3::Ones();
  std::string submesh{};  ///< name of the part to load; empty: all parts
  bool center = false;    ///< moves the centre of the part's bounding box to the origin
};

/// Each file is read once and shared by its users. Throws MeshError.
std::shared_ptr<const TriangleMesh> load_mesh(const MeshRequest& request, MeshReader& reader);

}  // namespace bubblesim
