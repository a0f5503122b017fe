// SPDX-License-Identifier: BSD-3-Clause
// Surfaces from mesh files: COLLADA, STL, OBJ and what else assimp reads.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "bubblesim/triangle_mesh.hpp"
#include "meshes/mesh_reader.hpp"

namespace bubblesim {

struct MeshRequest {
  std::filesystem::path file{};
  Vector3 scale = Vector3::One;
  std::string submesh{};  ///< name of the only part that is wanted; empty: all of them
  bool center = false;    ///< moves the middle of the box around that part to the origin
};

/// What is in a file is read once and shared as long as anybody uses it. Throws MeshError.
std::shared_ptr<const TriangleMesh> load_mesh(const MeshRequest& request, MeshReader& reader);

}  // namespace bubblesim
