// SPDX-License-Identifier: BSD-3-Clause
// Distance of convex shapes by the algorithm of Gilbert, Johnson and Keerthi (1988).
#pragma once

#include <array>
#include <limits>

#include "physics/convex/convex_shape.hpp"

namespace bubblesim {

/// A point of the Minkowski difference A - B of two cores.
struct DifferencePoint {
  Vector3 at;  // on_a - on_b
  Vector3 on_a;
  Vector3 on_b;
};
DifferencePoint difference_point(const ConvexShape& a, const ConvexShape& b, const Vector3& direction);

/// Result for the cores of two shapes; their roundings are not included.
struct CoreDistance {
  bool overlap = false;  // touch or overlap: the points are not set
  double distance = 0;   // m; a lower bound when it is above the limit of the search
  Vector3 on_a;          // nearest points
  Vector3 on_b;
  std::array<DifferencePoint, 4> simplex;  // around the origin, if they overlap
  int count = 0;
};

/// The search ends when the distance is known to be above `limit`, in m.
CoreDistance core_distance(const ConvexShape& a, const ConvexShape& b,
                           double limit = std::numeric_limits<double>::infinity());

}  // namespace bubblesim
