// SPDX-License-Identifier: BSD-3-Clause
// Arithmetic on whole packets of rays. Directions and planes are computed in double precision: single precision has an
// error of a millimetre on ground at a distance of 100 m.
#pragma once

#include <ignition/math/Matrix3.hh>

#include "bubblesim/math.hpp"
#include "rays/ray_packet.hpp"

namespace bubblesim::rays {

/// Sixteen directions in double precision, consecutive in memory.
struct DirectionLanes {
  const double* x;
  const double* y;
  const double* z;
};

/// Sets the directions of all rays: `turn` times the given ones.
void aim(RTCRay16& rays, const ignition::math::Matrix3d& turn, const DirectionLanes& directions);

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

/// Marks the used rays whose hit on a still face is from inside. Returns the marks of all rays combined, and in
/// `moving` whether a ray hit an instance, which has an id below `first_other`.
int hits_from_inside(const RTCRayHit16& packet, const RayMask& mask, unsigned first_other, RayMask& inside,
                     int& moving);

/// Moves the rays that hit the same shape as ray `i` from `left` to `same`.
void take_same(const RTCHit16& hits, std::size_t i, RayMask& left, RayMask& same);

}  // namespace bubblesim::rays
