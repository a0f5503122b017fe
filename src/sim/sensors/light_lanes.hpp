// SPDX-License-Identifier: BSD-3-Clause
// Arithmetic of the light that arrives at the ends of the sixteen rays of a packet.
#pragma once

#include "bubblesim/scene.hpp"
#include "sensors/shade_lanes.hpp"

namespace bubblesim::lanes {

/// Light at each place.
struct alignas(64) Arrivals {
  Places to_light;         // unit vectors
  float distance[kLanes];  // m
  float strength[kLanes];  // 0: none arrives, or from behind the surface
};
/// Adds `weight` times the sky's colour to the rays that are not in `mask`.
void add_sky(const RTCRay16& rays, const Mask& mask, float weight, Colors& sum);
/// Adds `weight` times a colour to the rays that are not in `mask`.
void add_beside(const Color& color, const Mask& mask, float weight, Colors& sum);
/// Adds `weight` * (surface * light + glow) to the rays in `mask`.
void add_ambient(const Colors& surface, const Color& light, const Colors& glow, const Mask& mask, float weight,
                 Colors& sum);

/// Light from one direction. Returns whether any arrives.
bool arrive_along(const Vector3& to_light, const Normals& normals, const Mask& mask, Arrivals& arrivals);
/// Light from a point or a spotlight. Returns whether any arrives.
bool arrive_from(const Light& light, const Places& places, const Normals& normals, const Mask& mask,
                 Arrivals& arrivals);

/// Rays from the places to the light; `lit` marks those to trace.
void aim_at_light(const RTCRay16& rays, const Places& places, const Normals& normals, const Arrivals& arrivals,
                  RTCRay16& shadows, Mask& lit);
/// Removes the light of places in shadow: those whose ray was found to be blocked.
void remove_shadows(const RTCRay16& shadows, Arrivals& arrivals);
/// Adds `weight` * surface * light * strength.
void add_light(const Colors& surface, const Color& light, const Arrivals& arrivals, float weight, Colors& sum);

}  // namespace bubblesim::lanes
