// SPDX-License-Identifier: BSD-3-Clause
// Colours of traced rays: Lambert's law with the scene's lights and shadows, and the sky.
#pragma once

#include <utility>
#include <vector>

#include "bubblesim/scene.hpp"
#include "bubblesim/world.hpp"
#include "rays/hit_groups.hpp"
#include "rays/ray_scene.hpp"
#include "sensors/shade_lanes.hpp"

namespace bubblesim {

class Shading {
 public:
  explicit Shading(Environment environment) : environment_(std::move(environment)) {}

  /// Collects the scene's lights and those of links, at their current poses, all `brightness` times as bright.
  void place_lights(const World& world, double brightness);

  /// Adds `weight` times the colours of the rays of a traced packet to `sum`.
  void add(const RayScene& scene, const rays::RayPacket& packet, const rays::HitGroups& groups, float weight,
           lanes::Colors& sum) const;

 private:
  Environment environment_;
  std::vector<Light> lights_;
  Color ambient_;
};

}  // namespace bubblesim
