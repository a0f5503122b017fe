// SPDX-License-Identifier: BSD-3-Clause
// Colours of traced rays: Lambert's law with the scene's lights and shadows, and the sky.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "bubblesim/scene.hpp"
#include "bubblesim/world.hpp"
#include "rays/ray_scene.hpp"

namespace bubblesim {

class Shading {
 public:
  explicit Shading(Environment environment) : environment_(std::move(environment)), lights_(environment_.lights) {}

  /// Collects the scene's lights and those of links, at their current poses.
  void place_lights(const World& world);

  /// Adds `weight` times the colours of the first `count` rays of a traced packet to `colors`.
  void add(const RayScene& scene, const rays::RayPacket& packet, std::size_t count, float weight, Color* colors) const;

 private:
  Color behind(const Vector3& direction) const;

  Environment environment_;
  std::vector<Light> lights_;
};

}  // namespace bubblesim
