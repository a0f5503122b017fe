// SPDX-License-Identifier: BSD-3-Clause
// What tests of meshes measure.
#pragma once

#include <cstdint>
#include <string>

#include "bubblesim/triangle_mesh.hpp"
#include "meshes/convex_hull.hpp"
#include "meshes/mesh_error.hpp"

namespace bubblesim::test {

constexpr double kMeshRounding = 1e-6;  // m, of single precision

/// m^3, of a closed surface that is wound outwards.
inline double volume(const TriangleMesh& mesh) {
  return enclosed_volume(mesh.triangles, [&](std::uint32_t i) {
    const TriangleMesh::Point& place = mesh.vertices[i];
    return Vector3(place[0], place[1], place[2]);
  });
}

/// The error of a call, an empty string without one.
template <class Call>
std::string mesh_problem(const Call& call) {
  try {
    call();
  } catch (const MeshError& error) {
    return error.what();
  }
  return "";
}

}  // namespace bubblesim::test
