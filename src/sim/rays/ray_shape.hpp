// SPDX-License-Identifier: BSD-3-Clause
// A shape as an Embree geometry. Flat shapes become faces; rays against round shapes, and boxes around a sensor, use
// the exact float64 formulas of ray_shapes.hpp. A new kind of geometry is added here only.
#pragma once

#include <array>

#include "bubblesim/scene.hpp"
#include "bubblesim/scene_tree.hpp"
#include "rays/embree_handles.hpp"
#include "rays/ray_packet.hpp"
#include "scene/transform.hpp"

namespace bubblesim::rays {

struct RayShape {
  Geometry geometry;
  Pose pose;                           ///< in the link's frame, or in the world's when the link is static
  Matrix3 turn = Matrix3::Identity();  ///< the pose's rotation and its inverse; faster than quaternions
  Matrix3 turn_back = Matrix3::Identity();
  Vector3 middle;    ///< of a sphere around it, in the frame of `pose`; not of a plane
  double reach = 0;  ///< m, the radius of that sphere
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

/// The corners of the faces of a box, counter-clockwise from outside. Bit `axis` of a corner: on the positive side.
constexpr std::array<unsigned, 24> kBoxFaces = {0, 4, 6, 2, 1, 3, 7, 5, 0, 1, 5, 4, 2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6};

/// A filter that rejects hits on faces from inside.
void keep_hits_from_outside(const RTCFilterFunctionNArguments* arguments);

/// Infinite planes have no bounding box: RayScene intersects them itself.
bool is_infinite(const Geometry& geometry);

/// Whether the shape is traced by its exact formulas, not as faces.
bool is_traced_as_round(const RayShape& shape);

/// Sets the pose, and what follows from it.
void place(RayShape& shape, const Pose& pose);

/// A shape that is traced as round, in the frame of rays that do not come from Embree.
struct PlacedRound {
  const RayShape* shape;
  Transform place;  ///< of the shape
  Vector3 middle;   ///< of the sphere around it
  unsigned geometry;
  unsigned instance;
};

PlacedRound placed_round(const RayShape& shape, const Transform& place, unsigned geometry, unsigned instance);

/// Shortens the used rays, which start at one point outside of the shape, where they meet it, and sets their hits.
void meet_round(const PlacedRound& round, const RayMask& mask, RTCRayHit16& packet);

/// Sets tfar of the used rays that meet the shape to -infinity.
void shade_round(const PlacedRound& round, const RayMask& mask, RTCRay16& rays);

/// Creates the Embree geometry of a shape; it keeps a pointer to the shape.
GeometryHandle make_geometry(const RayShape& shape);

}  // namespace bubblesim::rays
