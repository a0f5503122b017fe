// SPDX-License-Identifier: BSD-3-Clause
// Contacts of a convex shape with the triangles of a mesh.
#pragma once

#include <vector>

#include "physics/convex/manifold.hpp"
#include "physics/convex/triangle_tree.hpp"

namespace bubblesim {

/// Adds contact points, with normals into the shape. `mesh` is the frame of the triangles in the world. A triangle
/// pushes to the side on which the shape's centre is. At an edge of two triangles, the normal lies between theirs, so
/// that shapes do not catch on the edges inside a surface.
void add_terrain_contacts(const ConvexShape& shape, const TriangleTree& tree, const Transform& mesh,
                          std::vector<ManifoldPoint>& points);

/// The bounds of a shape in a frame.
Bounds bounds_in(const ConvexShape& shape, const Transform& frame);

}  // namespace bubblesim
