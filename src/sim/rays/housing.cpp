// SPDX-License-Identifier: BSD-3-Clause
#include "rays/housing.hpp"

#include <algorithm>

#include "bubblesim/triangle_mesh.hpp"
#include "rays/ray_shapes.hpp"

namespace bubblesim::rays {

std::vector<Vector3> sensor_positions(const ModelDescription& model) {
  std::vector<Vector3> positions;
  for (const LinkDescription& link : model.links) {
    for (const SensorDescription& sensor : link.sensors) positions.push_back((link.pose * sensor.pose).position);
  }
  return positions;
}

bool houses(const Geometry& geometry, const Pose& pose, const std::vector<Vector3>& sensors) {
  return std::any_of(sensors.begin(), sensors.end(), [&](const Vector3& sensor) {
    const Vector3 place = pose.orientation.conjugate() * (sensor - pose.position);
    const auto* mesh = std::get_if<Mesh>(&geometry);
    if (mesh == nullptr) return is_inside(place, geometry);
    const Vector3& low = mesh->triangles->low;
    const Vector3& high = mesh->triangles->high;
    return is_inside(place - (low + high) / 2, Box{high - low});
  });
}

}  // namespace bubblesim::rays
