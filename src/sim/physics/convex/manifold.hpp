// SPDX-License-Identifier: BSD-3-Clause
// Contact points of two convex shapes that overlap.
#pragma once

#include <vector>

#include "physics/convex/penetration.hpp"

namespace bubblesim {

struct ManifoldPoint {
  Vector3 at;        // midway between the surfaces, m, in the world
  Vector3 normal;    // into the first shape
  double depth = 0;  // of the overlap along the normal there, m
};

/// Adds the corners of the area in which the facing features of the shapes overlap along a normal, which points into
/// `a`; none counts as deeper than `most`. Returns the greatest depth, 0 if there is no such area.
double add_area(const ConvexShape& a, const ConvexShape& b, const Vector3& normal, double most,
                std::vector<ManifoldPoint>& points);

/// Adds the corners of the area in which the facing features of the shapes overlap along the normal, or the deepest
/// point if there is none.
void add_manifold(const ConvexShape& a, const ConvexShape& b, const Penetration& overlap,
                  std::vector<ManifoldPoint>& points);

}  // namespace bubblesim
