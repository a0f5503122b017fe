// SPDX-License-Identifier: BSD-3-Clause
// A convex polyhedron, prepared for collision detection.
#pragma once

#include <cstdint>
#include <vector>

#include "meshes/convex_hull.hpp"

namespace bubblesim {

/// In the frame of its mesh, m. Immutable, and shared between worlds.
struct ConvexPart {
  struct Face {
    Vector3 normal;           // outwards
    std::uint32_t first = 0;  // in `loops`
    std::uint32_t count = 0;  // corners
  };

  std::vector<Vector3> corners;
  std::vector<Face> faces;           // triangles of one plane are one face
  std::vector<std::uint32_t> loops;  // corners of the faces, counter-clockwise from outside
  /// The corners that share an edge with corner i: neighbours[start[i]] to neighbours[start[i + 1] - 1].
  std::vector<std::uint32_t> neighbours;
  std::vector<std::uint32_t> start;
  /// The faces at corner i, likewise.
  std::vector<std::uint32_t> faces_at;
  std::vector<std::uint32_t> face_start;
  Vector3 low;       // lower corner of the bounding box
  Vector3 high;      // upper corner
  Vector3 centre;    // a point inside
  double size = 0;   // length of the box's diagonal
  double reach = 0;  // greatest distance of a corner from the centre

  /// Index of a corner that is farthest in a direction. `from` is a corner near it, if one is known.
  std::uint32_t farthest(const Vector3& direction, std::uint32_t from) const;
};

/// The hull must have a volume.
ConvexPart make_part(const Hull& hull);

}  // namespace bubblesim
