// SPDX-License-Identifier: BSD-3-Clause
// Arithmetic on whole packets of rays. Directions and planes are computed in double precision: single precision has an
// error of a millimetre on ground at a distance of 100 m.
#pragma once

#include "bubblesim/math.hpp"
#include "bubblesim/scene_tree.hpp"
#include "rays/ray_packet.hpp"

namespace bubblesim::rays {

/// Sixteen directions in double precision, consecutive in memory.
struct DirectionLanes {
  const double* x;
  const double* y;
  const double* z;
};

/// Sets the directions of all rays: `turn` times the given ones.
void aim(RTCRay16& rays, const Matrix3& turn, const DirectionLanes& directions);

/// Sets the direction of ray `i` to `base` + left[i] * `side`.
void aim(RTCRay16& rays, const Vector3& base, const Vector3& side, const double* left);

/// An infinite plane, solid below.
struct PlaneEquation {
  Vector3 normal;
  double offset;  ///< normal * point for its points
};

/// Shortens the used rays that enter the plane before their end, and sets the ids of these hits.
void meet_plane(const PlaneEquation& plane, unsigned geometry, unsigned instance, const RayMask& mask,
                RTCRayHit16& packet);

/// Around rays that start at one point.
struct Cone {
  Vector3 apex;
  Vector3 axis;   ///< unit vector
  double cosine;  ///< of the angle between the axis and the side; negative: any direction
  double sine;
};
/// The cone of the used rays about one of them, a little wider than needed.
Cone cone_around(const RTCRay16& rays, const RayMask& mask);
/// Whether a sphere reaches into a cone; also true for some that are close to it.
bool reaches_into(const Vector3& centre, double radius, const Cone& cone);

/// Marks those of the used rays that can meet a sphere before they end; a margin covers rounding. Returns whether any
/// can.
bool can_meet_sphere(const RTCRay16& rays, const int* use, const Vector3& centre, double radius, RayMask& can);

/// Copies rays into a frame at `position` with the axes `turn`, without their hits.
void into_frame(const Matrix3& turn, const Vector3& position, const RTCRay16& rays, RTCRayHit16& turned);

/// Copies the hits of rays that were traced in the frame of an instance, and sets that.
void take_hits(const RTCRayHit16& turned, unsigned instance, const RayMask& mask, RTCRayHit16& packet);

/// Marks the used rays whose hit on a still face is from inside. Returns the marks of all rays combined, and in
/// `moving` whether a ray hit an instance, which has an id below `first_other`.
int hits_from_inside(const RTCRayHit16& packet, const RayMask& mask, unsigned first_other, RayMask& inside,
                     int& moving);

/// Marks the used rays that hit something. Returns whether all do.
bool find_hits(const RTCHit16& hits, const RayMask& mask, RayMask& found);

/// Moves the rays that hit the same shape as ray `i` from `left` to `same`. Returns whether any are left.
bool take_same(const RTCHit16& hits, std::size_t i, RayMask& left, RayMask& same);

/// Writes the distances of the marked rays, and `none` for others, of the first `count` rays.
void keep_distances(const RTCRay16& rays, const RayMask& mask, float none, std::size_t count, float* distances);
/// Writes `object` for the marked rays of the first `count`.
void keep_object(ObjectId object, const RayMask& mask, std::size_t count, ObjectId* objects);

}  // namespace bubblesim::rays
