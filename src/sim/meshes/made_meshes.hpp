// SPDX-License-Identifier: BSD-3-Clause
// Generated meshes.
#pragma once

#include <memory>
#include <vector>

#include "bubblesim/triangle_mesh.hpp"
#include "meshes/picture.hpp"

namespace bubblesim {

using Outline = std::vector<Eigen::Vector2d>;

/// Outlines in the xy plane, each extruded from z = 0 to its height. They may be concave, and run in either direction;
/// an outline inside another is a hole in it. Throws MeshError when one has no area or crosses itself.
struct Extrusion {
  Outline outline;
  double height = 1;
};
std::shared_ptr<const TriangleMesh> extrude(std::vector<Extrusion> parts);

/// A box of `height` on each pixel of an image that is darker than `threshold`, from 0 to 255. Pixels are `scale`
/// metres wide, the image's centre is at the origin and its upper edge at +y. Throws MeshError.
std::shared_ptr<const TriangleMesh> raise_walls(const Heights& picture, double scale, double threshold, double height);

/// A heightmap over a rectangle of `size` about `middle`; the image's upper edge is at +y, black at middle.z() and the
/// brightest pixel size.z() above it. Each pixel is a corner; images over 513 pixels wide or high are downsampled.
/// Throws MeshError.
std::shared_ptr<const TriangleMesh> raise_ground(const Heights& heights, const Vector3& size,
                                                 const Vector3& middle = {});

/// 1280 triangles with corners on the ellipsoid: at most 0.5 % of its radii below it.
std::shared_ptr<const TriangleMesh> tessellate(const Ellipsoid& ellipsoid);

}  // namespace bubblesim
