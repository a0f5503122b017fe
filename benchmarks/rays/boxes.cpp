// SPDX-License-Identifier: BSD-3-Clause
#include "boxes.hpp"

#include <cmath>
#include <random>

namespace bubblesim::benchmarks {

std::vector<RawLidar::PlacedBox> boxes_around(const Vector3& centre, double clear, std::size_t count) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-15, 15);
  std::uniform_real_distribution<double> size(0.2, 1.5);
  std::vector<RawLidar::PlacedBox> boxes;
  while (boxes.size() < count) {
    const Vector3 from_centre(place(random), place(random), 0.5);
    const Pose pose(centre + from_centre, from_rpy(0, 0, place(random)));
    if (std::hypot(from_centre.x(), from_centre.y()) < clear) continue;
    boxes.push_back({Box{{size(random), size(random), 1}}, pose});
  }
  return boxes;
}

ModelDescription model_of(const std::string& name, const Geometry& geometry, const Pose& pose, bool is_static) {
  CollisionDescription shape;
  shape.name = "shape";
  shape.geometry = geometry;
  LinkDescription link;
  link.name = "link";
  link.collisions.push_back(shape);
  ModelDescription model;
  model.name = name;
  model.pose = pose;
  model.is_static = is_static;
  model.links.push_back(link);
  return model;
}

}  // namespace bubblesim::benchmarks
