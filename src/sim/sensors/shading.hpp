// SPDX-License-Identifier: BSD-3-Clause
// Which colour a traced ray sees: Lambert's law under the scene's lights, their shadows, the sky.
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

  /// Takes the scene's lights and those that links carry, where these are now.
  void place_lights(const World& world);

  /// Adds `weight` times what the first `count` rays of a traced packet see to `colors`.
  void add(const RayScene& scene, const rays::RayPacket& packet, std::size_t count, float weight, Color* colors) const;

 private:
  Color behind(const Vector3& direction) const;

  Environment environment_;
  std::vector<Light> lights_;
};

}  // namespace bubblesim
