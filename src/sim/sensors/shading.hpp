// SPDX-License-Identifier: BSD-3-Clause
// Colours of traced rays: Lambert's law with the scene's lights and shadows, and the sky.
#pragma once

#include <utility>
#include <vector>

#include "bubblesim/scene.hpp"
#include "bubblesim/world.hpp"
#include "rays/faces_in_light.hpp"
#include "rays/hit_groups.hpp"
#include "rays/ray_scene.hpp"
#include "sensors/light_lanes.hpp"
#include "sensors/shade_lanes.hpp"
#include "sensors/surface_color.hpp"

namespace bubblesim {

class Shading {
 public:
  explicit Shading(Environment environment) : environment_(std::move(environment)) {}

  /// Collects the scene's lights and those of links, at their current poses, all `brightness` times as bright.
  void place_lights(const World& world, double brightness);

  /// Prepares the shadows of parallel light near the eye of an image of `pixels`, which then need few rays. Call it
  /// after place_lights().
  void place_casters(const RayScene& scene, const Vector3& eye, std::size_t pixels);

  /// Adds `weight` times the colours of the rays of a traced packet to `sum`.
  void add(const RayScene& scene, const rays::RayPacket& packet, const rays::HitGroups& groups, float weight,
           lanes::Colors& sum) const;

 private:
  void cast_shadows(const RayScene& scene, const rays::RayPacket& packet, const Surfaces& surfaces, std::size_t light,
                    lanes::Arrivals& arrivals) const;

  Environment environment_;
  std::vector<Light> lights_;
  std::vector<rays::FacesInLight> casters_;  // for each light; those of parallel light are used
  bool has_casters_ = false;
  Color ambient_;
};

}  // namespace bubblesim
