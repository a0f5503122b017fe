// SPDX-License-Identifier: BSD-3-Clause
// Scenes with the rays that their sensors trace.
#pragma once

#include <array>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "rays/ray_scene.hpp"
#include "scenes.hpp"
#include "surfaces.hpp"

namespace bubblesim::test {

/// A world and its ray scene.
struct Traced {
  static constexpr float kFar = 100;  // m

  explicit Traced(SceneDescription description) : scene(std::move(description)), world(scene, 0) {
    for (const ModelDescription& model : scene.models) {
      rays.add_model(world, world.tree().find("/" + model.name), model);
    }
    rays.refresh(world);
  }

  rays::RayPacket trace(const Vector3& origin, const Vector3& direction, ObjectId ignored = kNoObject,
                        bool coherent = false) const {
    rays::RayPacket packet;
    packet.start(origin, 0, kFar, 1);
    for (std::size_t i = 0; i < rays::kPacket; ++i) rays::aim(packet.data.ray, i, origin, direction);
    rays.trace(packet, coherent, ignored);
    return packet;
  }

  std::optional<RayHit> hit(const Vector3& origin, const Vector3& direction, ObjectId ignored = kNoObject,
                            bool coherent = false) const {
    const rays::RayPacket packet = trace(origin, direction, ignored, coherent);
    if (!packet.hit(0)) return std::nullopt;
    return RayHit{packet.data.ray.tfar[0], rays.normal(packet, 0), rays.shape(packet, 0).link};
  }

  bool lit(const Vector3& point, const Vector3& to_light) const {
    rays::RayPacket packet = trace({0, 0, 1e4}, Vector3::UnitZ());
    rays::aim(packet.data.ray, 0, point, to_light);
    rays.occlude(packet.data.ray, packet.mask);
    return packet.data.ray.tfar[0] >= 0;
  }

  ObjectId find(const char* path) const { return world.tree().find(path); }

  SceneDescription scene;
  World world;
  RayScene rays;
};

/// Shapes of all kinds in any pose; every second one can move.
inline SceneDescription clutter(std::mt19937& random, int count = 60) {
  std::uniform_real_distribution<double> place(-8, 8);
  std::uniform_real_distribution<double> angle(-3, 3);
  std::uniform_real_distribution<double> size(0.2, 2);
  std::vector<ModelDescription> models{floor()};
  for (int i = 0; i < count; ++i) {
    const Vector3 sizes(size(random), size(random), size(random));
    const std::array<Geometry, 6> kinds = {
        Box{sizes},           Sphere{sizes.x()}, Cylinder{sizes.x(), sizes.y()}, Capsule{sizes.x() / 2, sizes.y()},
        Ellipsoid{sizes / 2}, box_mesh(sizes)};
    const Geometry& geometry = kinds[static_cast<std::size_t>(i) % kinds.size()];
    LinkDescription body = link_with(geometry);
    body.collisions[0].pose = Pose(0.1, 0.2, -0.3, 0.5, -0.6, 0.7);
    const Pose pose(place(random), place(random), place(random) + 8, angle(random), angle(random), angle(random));
    models.push_back(model("Thing" + std::to_string(i), body, pose));
    models.back().is_static = i % 4 < 2;
  }
  return scene(models, Vector3::Zero());
}

}  // namespace bubblesim::test
