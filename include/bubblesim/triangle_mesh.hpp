// SPDX-License-Identifier: BSD-3-Clause
// Triangle meshes: from files, extruded polylines and heightmaps.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bubblesim/scene.hpp"

namespace bubblesim {

/// An image on a surface.
struct Texture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;  ///< three bytes per pixel, row by row from the top
};

/// Immutable once it is made, so shapes share it. A triangle is visible, and hit, from the side on which its corners
/// run counter-clockwise.
struct TriangleMesh {
  using Point = std::array<float, 3>;
  using Triangle = std::array<std::uint32_t, 3>;  ///< indices of its corners

  std::vector<Point> vertices;  ///< m
  std::vector<Triangle> triangles;
  std::vector<Point> normals;                             ///< per vertex, of a smooth surface; empty: flat triangles
  std::vector<std::array<float, 2>> texture_coordinates;  ///< per vertex, from the image's lower left corner, or empty
  std::vector<Material> materials;                        ///< of the mesh file; empty: none
  std::vector<std::uint16_t> material_of;                 ///< per triangle, index into materials; empty if materials is
  Vector3 low;                                            ///< lower corner of the bounding box
  Vector3 high;                                           ///< upper corner of the bounding box

  Vector3 corner(const Triangle& triangle, std::size_t i) const {
    const Point& point = vertices[triangle[i]];
    return {point[0], point[1], point[2]};
  }
};

}  // namespace bubblesim
