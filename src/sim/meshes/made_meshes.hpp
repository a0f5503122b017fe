// SPDX-License-Identifier: BSD-3-Clause
// Surfaces that are made, not read.
#pragma once

#include <ignition/math/Vector2.hh>
#include <memory>
#include <vector>

#include "bubblesim/triangle_mesh.hpp"
#include "meshes/picture.hpp"

namespace bubblesim {

using Outline = std::vector<ignition::math::Vector2d>;

/// Outlines in the xy plane, extruded from z = 0 to the height of each. They may be concave, and run either way round;
/// one that lies in another is a hole in it. Throws MeshError when one has no area or crosses itself.
struct Extrusion {
  Outline outline;
  double height = 1;
};
std::shared_ptr<const TriangleMesh> extrude(std::vector<Extrusion> parts);

/// A box of `height` on each pixel of a picture that is darker than `threshold`, from 0 to 255; pixels are `scale`
/// metres wide, the picture's middle is at the origin and its upper edge at +y. Throws MeshError.
std::shared_ptr<const TriangleMesh> raise_walls(const Heights& picture, double scale, double threshold, double height);

/// Ground over a rectangle of `size` about `middle`; the picture's upper edge lies at +y, black at middle.Z() and the
/// brightest pixel size.Z() above it. Each pixel is a corner; pictures over 513 pixels wide or high are thinned out.
/// Throws MeshError.
std::shared_ptr<const TriangleMesh> raise_ground(const Heights& heights, const Vector3& size,
                                                 const Vector3& middle = Vector3::Zero);

/// 1280 triangles with their corners on the ellipsoid: at most 0.5 % of its radii below it.
std::shared_ptr<const TriangleMesh> tessellate(const Ellipsoid& ellipsoid);

}  // namespace bubblesim
