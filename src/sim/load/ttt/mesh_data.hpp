// SPDX-License-Identifier: BSD-3-Clause
// The arrays of vertices and triangles, which meshes share.
#pragma once

#include <memory>
#include <vector>

#include "load/ttt/scene_file.hpp"
#include "load/ttt/tag_list.hpp"

namespace bubblesim::ttt {

/// The arrays of a file, in its order: each kind is counted from 0.
struct MeshData {
  std::vector<std::shared_ptr<const Vertices>> vertices;
  std::vector<std::shared_ptr<const Triangles>> triangles;

  /// Adds those of a list. Throws FormatError.
  void add(const TagList& list);
};

}  // namespace bubblesim::ttt
