// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bubblesim/triangle_mesh.hpp"

namespace bubblesim {

/// The convex hull of a mesh, without corners inside its faces; empty when the mesh is flat.
struct Hull {
  std::vector<Vector3> corners;
  std::vector<TriangleMesh::Triangle> triangles;  ///< counter-clockwise from outside
};
Hull convex_hull(const TriangleMesh& mesh);

/// Volume inside closed surfaces whose triangles run counter-clockwise from outside. m^3
template <class Corner>
double enclosed_volume(const std::vector<TriangleMesh::Triangle>& triangles, const Corner& corner) {
  double sixfold = 0;
  for (const auto& [a, b, c] : triangles) sixfold += Vector3(corner(a)).dot(Vector3(corner(b)).cross(corner(c)));
  return sixfold / 6;
}

}  // namespace bubblesim
