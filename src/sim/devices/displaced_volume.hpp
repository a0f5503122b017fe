// SPDX-License-Identifier: BSD-3-Clause
// The part of a solid below a plane: what a floating shape displaces.
#pragma once

#include "bubblesim/scene.hpp"

namespace bubblesim {

struct Displaced {
  double volume = 0;  ///< m^3
  Vector3 moment;     ///< m^4: the volume times its centroid, in the shape's frame
};

/// The points x of the shape with up . x <= height, in the shape's frame; `up` has length 1. Exact for boxes, spheres,
/// ellipsoids and closed meshes, to 1e-6 of the volume for cylinders and capsules. Planes have no volume.
Displaced displaced_below(const Geometry& geometry, const Vector3& up, double height);

/// The radius of a sphere about the shape's origin that contains the shape; 0 for a plane.
double reach_of(const Geometry& geometry);

}  // namespace bubblesim
