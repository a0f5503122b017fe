// SPDX-License-Identifier: BSD-3-Clause
// Exact intersections of a ray with each shape, in the shape's own frame.
#pragma once

#include <optional>

#include "bubblesim/scene.hpp"

namespace bubblesim {

struct Ray {
  Vector3 origin;
  Vector3 direction;  ///< unit length
};

struct ShapeHit {
  double distance = 0;
  Vector3 normal;  ///< outwards
};

/// The first point at which the ray enters the shape, if it is nearer than `max_distance`. A ray that starts inside a
/// shape does not hit it.
std::optional<ShapeHit> intersect(const Ray& ray, const Geometry& geometry, double max_distance);

/// Whether the point is inside the shape; a ray that starts there does not hit the shape.
bool is_inside(const Vector3& point, const Geometry& geometry);

}  // namespace bubblesim
