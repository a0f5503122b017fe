// SPDX-License-Identifier: BSD-3-Clause
// Reads mesh files with assimp.
#pragma once

#include <assimp/Importer.hpp>
#include <cstdint>
#include <memory>
#include <string>

#include "meshes/mesh_content.hpp"

struct aiScene;

namespace bubblesim {

/// Caches the last file, because scenes use several parts of one file.
class AssimpFile {
 public:
  /// Returns the requested mesh, or the reason of a failure.
  MeshContent read(const MeshQuery& query);
  /// Drops the last file, unless it is the requested one.
  void prepare(const MeshQuery& query);

 private:
  const aiScene& scene(const MeshQuery& query, bool by_name);

  std::unique_ptr<Assimp::Importer> importer_;
  std::string file_;
  std::uint64_t digest_ = 0;
  bool by_name_ = true;
};

}  // namespace bubblesim
