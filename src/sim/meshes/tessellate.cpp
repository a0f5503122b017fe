// SPDX-License-Identifier: BSD-3-Clause
// An icosahedron whose triangles are repeatedly divided into four, with the corners moved to the sphere.
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "meshes/finish_mesh.hpp"
#include "meshes/made_meshes.hpp"

namespace bubblesim {
namespace {

constexpr int kDivisions = 3;

struct UnitSphere {
  std::vector<Vector3> corners;
  std::vector<TriangleMesh::Triangle> triangles;
};

UnitSphere icosahedron() {
  const double t = (1 + std::sqrt(5.0)) / 2;
  UnitSphere sphere;
  for (const Vector3& corner : {Vector3(-1, t, 0), Vector3(1, t, 0), Vector3(-1, -t, 0), Vector3(1, -t, 0),
                                Vector3(0, -1, t), Vector3(0, 1, t), Vector3(0, -1, -t), Vector3(0, 1, -t),
                                Vector3(t, 0, -1), Vector3(t, 0, 1), Vector3(-t, 0, -1), Vector3(-t, 0, 1)}) {
    sphere.corners.push_back(corner.normalized());
  }
  sphere.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  return sphere;
}

void divide(UnitSphere& sphere) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [found, is_new] =
        middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(sphere.corners.size()));
    if (is_new) sphere.corners.push_back((sphere.corners[a] + sphere.corners[b]).normalized());
    return found->second;
  };
  std::vector<TriangleMesh::Triangle> finer;
  for (const auto& [a, b, c] : sphere.triangles) {
    const std::uint32_t ab = middle(a, b);
    const std::uint32_t bc = middle(b, c);
    const std::uint32_t ca = middle(c, a);
    finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
  }
  sphere.triangles = std::move(finer);
}

}  // namespace

std::shared_ptr<const TriangleMesh> tessellate(const Ellipsoid& ellipsoid) {
  UnitSphere sphere = icosahedron();
  for (int i = 0; i < kDivisions; ++i) divide(sphere);
  TriangleMesh mesh;
  for (const Vector3& corner : sphere.corners) {
    const Vector3 place = corner.cwiseProduct(ellipsoid.radii);
    mesh.vertices.push_back(
        {static_cast<float>(place.x()), static_cast<float>(place.y()), static_cast<float>(place.z())});
  }
  mesh.triangles = std::move(sphere.triangles);
  return finish_mesh(std::move(mesh));
}

}  // namespace bubblesim
