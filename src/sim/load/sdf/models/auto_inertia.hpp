// SPDX-License-Identifier: BSD-3-Clause
// <inertial auto="true">: mass, centre of mass and inertia of a link from its collision shapes.
#pragma once

#include <string>
#include <vector>

#include "bubblesim/math.hpp"
#include "bubblesim/scene.hpp"
#include "load/load_context.hpp"
#include "load/sdf/elements/sdf_element.hpp"

namespace bubblesim {

/// A homogeneous solid.
struct Solid {
  double volume = 0;                        ///< m^3
  Vector3 centre;                           ///< centroid, in the shape's frame
  Matrix3 second_moment = Matrix3::Zero();  ///< m^5: the integral of x x^T about the centroid, along the shape's axes
  bool is_closed = true;                    ///< false: a mesh with holes, whose volume is not defined
};

/// Exact for all shapes. Planes have no volume.
Solid solid_of(const Geometry& geometry);

/// Sets mass, centre of mass and inertia of a link: the sum over its collision shapes times their <density>, scaled to
/// the <mass> if there is one. `read` are the elements that `link.collisions` come from.
void set_auto_inertia(const SdfElement& inertial, const std::vector<SdfElement>& read, const std::string& path,
                      LinkDescription& link, LoadContext& context);

}  // namespace bubblesim
