// SPDX-License-Identifier: BSD-3-Clause
// Surfaces that are made, not read.
#pragma once

#include <ignition/math/Vector2.hh>
#include <memory>
#include <vector>

#include "bubblesim/triangle_mesh.hpp"
#include "meshes/picture.hpp"

namespace bubblesim {

/// An outline in the xy plane, extruded from z = 0 to `height`. It may be concave, and run either way round. Throws
/// MeshError when it has no area or crosses itself.
std::shared_ptr<const TriangleMesh> extrude(std::vector<ignition::math::Vector2d> outline, double height);

/// Ground over a rectangle of `size` about `middle`; the picture's upper edge lies at +y, black at middle.Z() and the
/// brightest pixel size.Z() above it. Each pixel is a corner; pictures over 513 pixels wide or high are thinned out.
/// Throws MeshError.
std::shared_ptr<const TriangleMesh> raise_ground(const Heights& heights, const Vector3& size,
                                                 const Vector3& middle = Vector3::Zero);

/// Adds the triangles of a mesh to another, without their looks.
void append(const TriangleMesh& mesh, TriangleMesh& to);

/// 1280 triangles with their corners on the ellipsoid: at most 0.5 % of its radii below it.
std::shared_ptr<const TriangleMesh> tessellate(const Ellipsoid& ellipsoid);

}  // namespace bubblesim
