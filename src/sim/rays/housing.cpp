// SPDX-License-Identifier: BSD-3-Clause
#include "rays/housing.hpp"

#include <algorithm>

#include "bubblesim/triangle_mesh.hpp"
#include "rays/ray_shapes.hpp"

namespace bubblesim::rays {

std::vector<Vector3> sensor_positions(const World& world, ObjectId model) {
  std::vector<Vector3> positions;
  for (const ObjectKind carrier : {ObjectKind::kLink, ObjectKind::kJoint}) {
    for (const ObjectId part : world.tree().parts(model, carrier)) {
      for (const ObjectId sensor : world.tree().children(part, ObjectKind::kSensor)) {
        positions.push_back(world.pose(sensor).Pos());
      }
    }
  }
  return positions;
}

bool houses(const Geometry& geometry, const Pose& pose, const std::vector<Vector3>& sensors) {
  return std::any_of(sensors.begin(), sensors.end(), [&](const Vector3& sensor) {
    const Vector3 place = pose.Rot().RotateVectorReverse(sensor - pose.Pos());
    const auto* mesh = std::get_if<Mesh>(&geometry);
    if (mesh == nullptr) return is_inside(place, geometry);
    const Vector3& low = mesh->triangles->low;
    const Vector3& high = mesh->triangles->high;
    return is_inside(place - (low + high) / 2, Box{high - low});
  });
}

}  // namespace bubblesim::rays
