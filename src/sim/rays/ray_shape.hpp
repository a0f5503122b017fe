// SPDX-License-Identifier: BSD-3-Clause
// One shape as Embree holds it. Flat shapes become faces; round ones are met by the exact float64 formulas of
// ray_shapes.hpp. A new kind of geometry finds its form here and nowhere else.
#pragma once

#include <ignition/math/Matrix3.hh>

#include "bubblesim/scene.hpp"
#include "bubblesim/scene_tree.hpp"
#include "rays/embree_handles.hpp"

namespace bubblesim::rays {

struct RayShape {
  Geometry geometry;
  Pose pose;                      ///< in the link's frame, or in the world's when the link is static
  ignition::math::Matrix3d turn;  ///< the pose's rotation, and its inverse: quaternions would take longer for each ray
  ignition::math::Matrix3d turn_back;
  Material material;
  bool keeps_mesh_materials = false;
  bool cast_shadows = true;
  float laser_retro = 0;
  ObjectId link = kNoObject;
  ObjectId model = kNoObject;
};

/// Of a mesh's triangle at a place that Embree tells by u and v, in the shape's outer frame and of unit length; the
/// zero vector when the mesh is flat there.
Vector3 smooth_normal(const RayShape& shape, unsigned triangle, float u, float v);

/// What a query asks of Embree beside the rays; handed to every callback.
struct QueryContext {
  RTCIntersectContext embree;  // first: Embree hands back a pointer to it
  ObjectId ignored_model = kNoObject;
};

/// Infinite planes have no place in a tree of boxes: RayScene meets them itself.
bool is_infinite(const Geometry& geometry);

/// The shape as a geometry of Embree, which keeps a pointer to it.
GeometryHandle make_geometry(const RayShape& shape);

}  // namespace bubblesim::rays
