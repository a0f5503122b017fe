// SPDX-License-Identifier: BSD-3-Clause
// Penetration of convex shapes: the shortest translation that separates them.
#pragma once

#include <optional>

#include "physics/convex/convex_shape.hpp"

namespace bubblesim {

struct Penetration {
  Vector3 normal;    // of length 1, from b to a
  double depth = 0;  // m, along it
  Vector3 point;     // between the surfaces where they overlap most
};

/// Empty when the shapes are apart. The depth is exact for its normal; the normal is that of the shortest translation
/// for polytopes, and within about 1e-4 rad for cylinders. A face of a shape is preferred to edges that are as deep.
std::optional<Penetration> penetration(const ConvexShape& a, const ConvexShape& b);

/// The translation of `a` along `normal` that separates the shapes, m; negative when they are apart along it.
double depth_along(const ConvexShape& a, const ConvexShape& b, const Vector3& normal);

}  // namespace bubblesim
