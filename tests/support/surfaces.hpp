// SPDX-License-Identifier: BSD-3-Clause
// Meshes of shapes with known behaviour.
#pragma once

#include "bubblesim/triangle_mesh.hpp"
#include "meshes/finish_mesh.hpp"

namespace bubblesim::test {

/// The faces of a box, wound outwards.
inline TriangleMesh box_triangles(const Vector3& size) {
  TriangleMesh mesh;
  for (int corner = 0; corner < 8; ++corner) {
    const auto side = [corner](int axis) { return (corner >> axis & 1) != 0 ? 0.5 : -0.5; };
    const Vector3 place = size.cwiseProduct(Vector3(side(0), side(1), side(2)));
    mesh.vertices.push_back(
        {static_cast<float>(place.x()), static_cast<float>(place.y()), static_cast<float>(place.z())});
  }
  mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  return mesh;
}

inline Mesh box_mesh(const Vector3& size) { return Mesh{finish_mesh(box_triangles(size))}; }

}  // namespace bubblesim::test
