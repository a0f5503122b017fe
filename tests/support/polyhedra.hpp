// SPDX-License-Identifier: BSD-3-Clause
// Corners of polyhedra about the origin, and meshes of them.
#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "bubblesim/triangle_mesh.hpp"
#include "meshes/convex_hull.hpp"
#include "meshes/finish_mesh.hpp"

namespace bubblesim::test {

inline std::vector<Vector3> cube(double side) {
  std::vector<Vector3> corners;
  for (const double x : {-side / 2, side / 2}) {
    for (const double y : {-side / 2, side / 2}) {
      for (const double z : {-side / 2, side / 2}) corners.emplace_back(x, y, z);
    }
  }
  return corners;
}

/// The others have their corners at `radius`.
inline std::vector<Vector3> tetrahedron(double radius) {
  const double c = radius / std::sqrt(3.0);
  return {{c, c, c}, {c, -c, -c}, {-c, c, -c}, {-c, -c, c}};
}

inline std::vector<Vector3> octahedron(double radius) {
  return {{radius, 0, 0}, {-radius, 0, 0}, {0, radius, 0}, {0, -radius, 0}, {0, 0, radius}, {0, 0, -radius}};
}

inline std::vector<Vector3> icosahedron(double radius) {
  const double golden = (1 + std::sqrt(5.0)) / 2;
  const double a = radius / std::sqrt(1 + golden * golden);
  std::vector<Vector3> corners;
  for (const double s : {-a, a}) {
    for (const double t : {-a * golden, a * golden}) {
      corners.insert(corners.end(), {{0, s, t}, {s, t, 0}, {t, 0, s}});
    }
  }
  return corners;
}

/// The mesh of a convex polyhedron with these corners.
inline std::shared_ptr<const TriangleMesh> hull_mesh(const std::vector<Vector3>& corners) {
  TriangleMesh cloud;
  for (const Vector3& corner : corners) {
    cloud.vertices.push_back(
        {static_cast<float>(corner.x()), static_cast<float>(corner.y()), static_cast<float>(corner.z())});
  }
  const Hull hull = convex_hull(cloud);
  TriangleMesh mesh;
  for (const Vector3& corner : hull.corners) {
    mesh.vertices.push_back(
        {static_cast<float>(corner.x()), static_cast<float>(corner.y()), static_cast<float>(corner.z())});
  }
  mesh.triangles = hull.triangles;
  return finish_mesh(std::move(mesh));
}

}  // namespace bubblesim::test
