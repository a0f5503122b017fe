// SPDX-License-Identifier: BSD-3-Clause
// The meshes and textures of a scene as files beside it.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "load/ttt/names.hpp"
#include "load/ttt/scene_file.hpp"

namespace bubblesim::ttt {

/// Writes into the folders `meshes` and `textures` of a folder, at the first need. Throws std::runtime_error when the
/// disk is full.
class MeshFiles {
 public:
  MeshFiles(std::filesystem::path folder, const SceneFile& file) : folder_(std::move(folder)), file_(file) {}

  /// Writes one OBJ file of several parts, in the frame of their shape; returns its path from the folder. `is_seen`: of
  /// flat ones both sides.
  std::string write(const std::string& name, const std::vector<const Part*>& parts, bool is_seen = false);
  /// Writes the texture of a part; empty when it has none that can be shown.
  std::string texture(const Part& part);

 private:
  std::filesystem::path folder_;
  const SceneFile& file_;
  UniqueNames names_;
  std::map<int, std::string> textures_;
};

}  // namespace bubblesim::ttt
