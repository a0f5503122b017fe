// SPDX-License-Identifier: BSD-3-Clause
// Pieces of a triangle mesh between planes across its axes.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "bubblesim/triangle_mesh.hpp"
#include "meshes/convex_hull.hpp"

namespace bubblesim {

using MeshPoint = TriangleMesh::Point;
using PieceEdge = std::pair<std::uint32_t, std::uint32_t>;

/// The surface of the mesh in a box, as convex polygons.
struct MeshPiece {
  std::vector<MeshPoint> points;
  std::vector<std::vector<std::uint32_t>> polygons;
  MeshPoint low{};
  MeshPoint high{};
  Hull hull;          ///< of the points
  double volume = 0;  ///< of the hull, m^3
  double excess = 0;  ///< of the hull over the mesh in the box, m^3

  /// Each once, from the lower index to the higher.
  std::vector<PieceEdge> edges() const;
};

MeshPiece whole(const TriangleMesh& mesh);

/// The half of a piece on one side of a plane; without polygons in the plane, whose corners others have too.
MeshPiece cut(const MeshPiece& piece, std::size_t axis, float at, bool upper);

/// Where an edge crosses a plane.
MeshPoint crossing(const MeshPoint& a, const MeshPoint& b, std::size_t axis, float at);

/// Volume below a plane x = at, by the flux of (x - at, 0, 0) through the surface: caps across y and z have none.
double flux_volume(const MeshPiece& piece, std::size_t axis, double at);

inline double length_along(const MeshPiece& piece, std::size_t axis) {
  return double{piece.high[axis]} - piece.low[axis];
}

}  // namespace bubblesim
