// SPDX-License-Identifier: BSD-3-Clause
// The shapes and lights of a world at their current poses, and rays against the shapes.
#pragma once

#include <optional>
#include <vector>

#include "bubblesim/math.hpp"
#include "bubblesim/scene.hpp"
#include "bubblesim/scene_tree.hpp"
#include "bubblesim/world_part.hpp"

namespace bubblesim {

/// Result of a ray cast.
struct RayHit {
  double distance = 0;  ///< m, from the ray's origin
  Vector3 normal;       ///< of the surface, world axes
  ObjectId link = kNoObject;
};

/// A shape at its current pose, for drawings and tools.
struct PlacedShape {
  ObjectId link = kNoObject;
  bool is_static = false;
  Geometry geometry;
  Pose pose;  ///< in the world
};

class WorldGeometry : public WorldPart {
 public:
  using WorldPart::WorldPart;

  /// The nearest hit of a ray of length `max_distance`; the model `ignored_model` is ignored.
  std::optional<RayHit> cast_ray(const Vector3& origin, const Vector3& unit_direction, double max_distance,
                                 ObjectId ignored_model = kNoObject) const;
  std::vector<PlacedShape> shapes() const;
  /// The lights of links, at their current poses.
  std::vector<Light> link_lights() const;
};

}  // namespace bubblesim
