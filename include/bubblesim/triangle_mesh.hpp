// SPDX-License-Identifier: BSD-3-Clause
// Surfaces made of triangles: meshes from files, extruded polylines and heightmaps.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bubblesim/scene.hpp"

namespace bubblesim {

/// A picture that covers a surface.
struct Texture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;  ///< three bytes a pixel, row by row, the uppermost first
};

/// Never changes once it is made, so that shapes share it. A triangle is seen, and hit, from the side from which its
/// corners run counter-clockwise.
struct TriangleMesh {
  using Point = std::array<float, 3>;
  using Triangle = std::array<std::uint32_t, 3>;  ///< indices of its corners

  std::vector<Point> vertices;  ///< m
  std::vector<Triangle> triangles;
  std::vector<Point> normals;  ///< by vertex, of a smooth surface; empty: each triangle is flat
  std::vector<std::array<float, 2>> texture_coordinates;  ///< by vertex, from the picture's lower left corner; or empty
  std::vector<Material> materials;                        ///< that the mesh brings; empty when it brings none
  std::vector<std::uint16_t> material_of;                 ///< by triangle, index into materials; empty like these
  Vector3 low;                                            ///< corner of the box around it
  Vector3 high;

  Vector3 corner(const Triangle& triangle, std::size_t i) const {
    const Point& point = vertices[triangle[i]];
    return {point[0], point[1], point[2]};
  }
};

}  // namespace bubblesim
