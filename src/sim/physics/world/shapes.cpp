// SPDX-License-Identifier: BSD-3-Clause
// Ray casts against the world's shapes.
#include "bubblesim/world.hpp"
#include "physics/world/state.hpp"
#include "rays/ray_shapes.hpp"

namespace bubblesim {

std::optional<RayHit> World::cast_ray(const Vector3& origin, const Vector3& unit_direction, double max_distance,
                                      ObjectId ignored_model) const {
  std::optional<RayHit> nearest;
  for (const auto& model : state_->models) {
    if (model->object == ignored_model) continue;
    for (const Collider& collider : model->colliders) {
      const Pose pose = link_pose(*collider.link) * collider.in_link;
      const Ray ray{pose.orientation.conjugate() * (origin - pose.position),
                    pose.orientation.conjugate() * unit_direction};
      const std::optional<ShapeHit> hit = intersect(ray, collider.geometry, nearest ? nearest->distance : max_distance);
      if (hit) nearest = RayHit{hit->distance, pose.orientation * hit->normal, collider.link->object};
    }
  }
  return nearest;
}

}  // namespace bubblesim
