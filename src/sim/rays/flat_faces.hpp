// SPDX-License-Identifier: BSD-3-Clause
// The flat faces of boxes and meshes.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "bubblesim/scene.hpp"
#include "bubblesim/triangle_mesh.hpp"
#include "rays/ray_shape.hpp"
#include "scene/transform.hpp"

namespace bubblesim::rays {

/// The most triangles of meshes that are rasterized for an image of `pixels`; rays are faster among more.
inline std::size_t most_triangles(std::size_t pixels) { return std::min<std::size_t>(4096, pixels / 64); }

/// Calls take(corners, their number, number of the face) for each face of a box at `place`. The corners run
/// counter-clockwise from outside; those that faces share are equal to the last bit.
template <class Take>
void for_each_face(const Box& box, const Transform& place, const Take& take) {
  const Matrix3 half = place.rotation * (box.size / 2).asDiagonal();
  std::array<Vector3, 8> corners;
  for (std::size_t corner = 0; corner < corners.size(); ++corner) {
    const auto side = [corner](std::size_t axis) { return (corner >> axis & 1U) != 0 ? 1.0 : -1.0; };
    corners[corner] = place.position + half * Vector3(side(0), side(1), side(2));
  }
  for (std::size_t face = 0; face < kBoxFaces.size() / 4; ++face) {
    std::array<Vector3, 4> of_face;
    for (std::size_t i = 0; i < of_face.size(); ++i) of_face[i] = corners[kBoxFaces[4 * face + i]];
    take(of_face.data(), of_face.size(), face);
  }
}

/// The same for the triangles of a mesh; from its front, they run counter-clockwise.
template <class Take>
void for_each_face(const TriangleMesh& mesh, const Transform& place, const Take& take) {
  std::vector<Vector3> vertices;
  vertices.reserve(mesh.vertices.size());
  for (const TriangleMesh::Point& point : mesh.vertices) {
    vertices.emplace_back(place * Vector3(point[0], point[1], point[2]));
  }
  for (std::size_t number = 0; number < mesh.triangles.size(); ++number) {
    const TriangleMesh::Triangle& triangle = mesh.triangles[number];
    const std::array<Vector3, 3> corners = {vertices[triangle[0]], vertices[triangle[1]], vertices[triangle[2]]};
    take(corners.data(), corners.size(), number);
  }
}

}  // namespace bubblesim::rays
