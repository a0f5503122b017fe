// SPDX-License-Identifier: BSD-3-Clause
// Mesh files as assimp reads them.
#pragma once

#include <assimp/Importer.hpp>
#include <cstdint>
#include <memory>
#include <string>

#include "meshes/mesh_content.hpp"

struct aiScene;

namespace bubblesim {

/// Keeps the last file, because scenes take several parts of one.
class AssimpFile {
 public:
  /// The surface asked for, or the reason why there is none.
  MeshContent read(const MeshQuery& query);
  /// Lets go of the last file, unless it is the one asked for.
  void prepare(const MeshQuery& query);

 private:
  const aiScene& scene(const MeshQuery& query, bool by_name);

  std::unique_ptr<Assimp::Importer> importer_;
  std::string file_;
  std::uint64_t digest_ = 0;
  bool by_name_ = true;
};

}  // namespace bubblesim
