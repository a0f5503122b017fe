// SPDX-License-Identifier: BSD-3-Clause
#include "load/ttt/texture_projection.hpp"

#include <cmath>

namespace bubblesim::ttt {
namespace {

using Point = std::array<double, 2>;

/// Of the side of a cube to which a normal points, to the right and up as seen from outside.
Point on_cube(const Vector3& p, const Vector3& normal) {
  const Vector3 size = normal.cwiseAbs();
  if (size.z() >= size.x() && size.z() >= size.y()) return {normal.z() < 0 ? -p.x() : p.x(), p.y()};
  if (size.x() >= size.y()) return {normal.x() < 0 ? -p.y() : p.y(), p.z()};
  return {normal.y() < 0 ? p.x() : -p.x(), p.z()};
}

}  // namespace

std::vector<std::array<float, 2>> projected(const Part& part, const Projection& projection) {
  const bool is_cube = projection.mode == ProjectionMode::kCube;
  if (!is_cube && projection.mode != ProjectionMode::kPlane) return {};
  constexpr double kSmallest = 1e-6;
  if (!(projection.size[0] > kSmallest) || !(projection.size[1] > kSmallest)) return {};
  const Pose to_image = projection.frame.inverse() * part.frame;
  std::vector<std::array<float, 2>> coordinates;
  coordinates.reserve(3 * part.triangles->size());
  for (const auto& triangle : *part.triangles) {
    std::array<Vector3, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& v = (*part.vertices)[triangle[i]];
      corners[i] = to_image * Vector3(v[0], v[1], v[2]);
    }
    const Vector3 normal = Vector3(corners[1] - corners[0]).cross(Vector3(corners[2] - corners[0]));
    for (const Vector3& corner : corners) {
      const Point point = is_cube ? on_cube(corner, normal) : Point{corner.x(), corner.y()};
      std::array<float, 2>& made = coordinates.emplace_back();
      for (std::size_t i = 0; i < 2; ++i) {
        constexpr double kEdge = 0.01;
        const double value = 0.5 + point[i] / projection.size[i];
        if (!projection.repeats[i] && (value < -kEdge || value > 1 + kEdge)) return {};
        made[i] = static_cast<float>(value);
      }
    }
  }
  return coordinates;
}

}  // namespace bubblesim::ttt
