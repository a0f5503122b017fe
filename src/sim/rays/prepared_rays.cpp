// SPDX-License-Identifier: BSD-3-Clause
#include "rays/prepared_rays.hpp"

#include <algorithm>
#include <mutex>
#include <variant>

#include "rays/housing.hpp"

namespace bubblesim::rays {
namespace {

VisualDescription as_visual(const CollisionDescription& collision) {
  VisualDescription visual;
  visual.pose = collision.pose;
  visual.geometry = collision.geometry;
  return visual;
}

RayShape make_shape(const VisualDescription& visual, const Pose& pose) {
  RayShape shape;
  shape.geometry = visual.geometry;
  place(shape, pose);
  shape.material = visual.material;
  shape.keeps_mesh_materials = visual.keeps_mesh_materials;
  shape.cast_shadows = visual.cast_shadows;
  shape.laser_retro = static_cast<float>(visual.laser_retro);
  return shape;
}

void add_static(RayModel& model, const RayShape& shape) {
  if (const auto* plane = std::get_if<Plane>(&shape.geometry)) {
    const Vector3 normal = shape.pose.orientation * plane->normal.normalized();
    model.planes.push_back({&shape, {normal, normal.dot(shape.pose.position)}});
  } else {
    model.fixed.push_back({&shape, make_geometry(shape)});
  }
}

RayModel::Link make_link(ObjectId id, const std::vector<const RayShape*>& shapes) {
  RayModel::Link link;
  link.id = id;
  link.scene = make_scene(RTC_BUILD_QUALITY_MEDIUM);
  for (const RayShape* shape : shapes) {
    if (is_infinite(shape->geometry)) continue;  // a moving plane is an error of the scene check
    rtcAttachGeometry(link.scene.get(), make_geometry(*shape).get());
    link.shapes.push_back(shape);
  }
  rtcCommitScene(link.scene.get());
  for (const RayShape* shape : link.shapes) link.middle += shape->middle / static_cast<double>(link.shapes.size());
  for (const RayShape* shape : link.shapes) {
    link.reach = std::max(link.reach, (shape->middle - link.middle).norm() + shape->reach);
  }
  return link;
}

}  // namespace

SharedRayModel prepare_rays(const SceneTree& tree, ObjectId model, const ModelDescription& description) {
  auto prepared = std::make_shared<RayModel>();
  prepared->object = model;
  const bool visuals = std::any_of(description.links.begin(), description.links.end(),
                                   [](const LinkDescription& link) { return !link.visuals.empty(); });
  const std::vector<ObjectId> ids = tree.parts(model, ObjectKind::kLink);
  const std::vector<Vector3> sensors = sensor_positions(description);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const LinkDescription& link = description.links[i];
    const Pose pose = description.is_static ? description.pose * link.pose : Pose();
    std::vector<const RayShape*> shapes;
    const auto add = [&](const VisualDescription& visual) {
      RayShape shape = make_shape(visual, pose * visual.pose);
      shape.link = ids[i];
      shape.model = model;
      shape.houses_sensor = houses(visual.geometry, link.pose * visual.pose, sensors);
      shapes.push_back(prepared->shapes.emplace_back(std::make_unique<RayShape>(std::move(shape))).get());
    };
    if (visuals) {
      for (const VisualDescription& visual : link.visuals) add(visual);
    } else {
      for (const CollisionDescription& collision : link.collisions) add(as_visual(collision));
    }
    if (description.is_static) {
      for (const RayShape* shape : shapes) add_static(*prepared, *shape);
    } else if (!shapes.empty()) {
      prepared->links.push_back(make_link(ids[i], shapes));
    }
  }
  return prepared;
}

SharedRayModel loosened(const RayModel& model, ObjectId link, const Pose& pose) {
  auto loose = std::make_shared<RayModel>();
  loose->object = model.object;
  std::vector<const RayShape*> shapes;
  for (const RayModel::Fixed& fixed : model.fixed) {
    if (fixed.shape->link != link) continue;
    RayShape shape = *fixed.shape;
    place(shape, pose.inverse() * shape.pose);
    shapes.push_back(loose->shapes.emplace_back(std::make_unique<RayShape>(std::move(shape))).get());
  }
  if (!shapes.empty()) loose->links.push_back(make_link(link, shapes));
  return loose;
}

std::shared_ptr<const StaticRays> gather_statics(const std::vector<SharedRayModel>& models,
                                                 const std::set<ObjectId>& loose) {
  // Simulations in other threads may attach the same geometries; Embree does not document that it allows that.
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  auto statics = std::make_shared<StaticRays>();
  statics->scene = make_scene(RTC_BUILD_QUALITY_HIGH);
  statics->housings = make_scene(RTC_BUILD_QUALITY_HIGH);
  for (const SharedRayModel& model : models) {
    for (const auto& [shape, geometry] : model->fixed) {
      if (loose.count(shape->link) > 0) continue;
      const auto id = static_cast<unsigned>(statics->shapes.size());
      statics->shapes.push_back(shape);
      if (is_traced_as_round(*shape) && shape->houses_sensor) {
        rtcAttachGeometryByID(statics->housings.get(), geometry.get(), id);
        statics->housing_shapes.push_back(shape);
      } else {
        rtcAttachGeometryByID(statics->scene.get(), geometry.get(), id);
      }
    }
  }
  rtcCommitScene(statics->scene.get());
  rtcCommitScene(statics->housings.get());
  check_embree();
  return statics;
}

}  // namespace bubblesim::rays
