// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/world_geometry.hpp"
#include "physics/world/state.hpp"
#include "rays/ray_shapes.hpp"

namespace bubblesim {

std::optional<RayHit> WorldGeometry::cast_ray(const Vector3& origin, const Vector3& unit_direction, double max_distance,
                                              ObjectId ignored_model) const {
  std::optional<RayHit> nearest;
  for (const auto& model : state().models) {
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

std::vector<PlacedShape> WorldGeometry::shapes() const {
  std::vector<PlacedShape> shapes;
  for (const auto& model : state().models) {
    for (const Collider& collider : model->colliders) {
      shapes.push_back({collider.link->object, model->description.is_static, collider.geometry,
                        link_pose(*collider.link) * collider.in_link});
    }
  }
  return shapes;
}

std::vector<Light> WorldGeometry::link_lights() const {
  std::vector<Light> lights;
  for (const auto& model : state().models) {
    for (std::size_t i = 0; i < model->links.size(); ++i) {
      for (Light light : model->description.links[i].lights) {
        const Pose pose = link_pose(model->links[i]);
        light.position = pose * light.position;
        light.direction = pose.orientation * light.direction;
        lights.push_back(std::move(light));
      }
    }
  }
  return lights;
}

}  // namespace bubblesim
