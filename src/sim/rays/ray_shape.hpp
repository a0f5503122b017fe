// SPDX-License-Identifier: BSD-3-Clause
// A shape as an Embree geometry. Flat shapes become faces; rays against round shapes, and boxes around a sensor, use
// the exact float64 formulas of ray_shapes.hpp. A new kind of geometry is added here only.
#pragma once

#include "bubblesim/scene.hpp"
#include "bubblesim/scene_tree.hpp"
#include "rays/embree_handles.hpp"

namespace bubblesim::rays {

struct RayShape {
  Geometry geometry;
  Pose pose;                           ///< in the link's frame, or in the world's when the link is static
  Matrix3 turn = Matrix3::Identity();  ///< the pose's rotation and its inverse; faster than quaternions
  Matrix3 turn_back = Matrix3::Identity();
  Material material;
  bool keeps_mesh_materials = false;
  bool cast_shadows = true;
  float laser_retro = 0;
  ObjectId link = kNoObject;
  ObjectId model = kNoObject;
  bool houses_sensor = false;  ///< a sensor of the model is inside it at first; traced so that it is ignored quickly
};

/// Context of an Embree query, passed to every callback.
struct QueryContext {
  EmbreeQuery embree;  // must be first: Embree passes a pointer to it
  ObjectId ignored_model = kNoObject;
};

/// A filter that rejects hits on faces from inside.
void keep_hits_from_outside(const RTCFilterFunctionNArguments* arguments);

/// Infinite planes have no bounding box: RayScene intersects them itself.
bool is_infinite(const Geometry& geometry);

/// Whether the shape is traced by its exact formulas, not as faces.
bool is_traced_as_round(const RayShape& shape);

/// Creates the Embree geometry of a shape; it keeps a pointer to the shape.
GeometryHandle make_geometry(const RayShape& shape);

}  // namespace bubblesim::rays
