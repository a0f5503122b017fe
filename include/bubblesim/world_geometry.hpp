// SPDX-License-Identifier: BSD-3-Clause
// The shapes and lights of a world at their current poses, and rays against the shapes.
#pragma once

#include <optional>
#include <utility>
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

/// Where two sets of links are nearest to each other.
struct NearestPoints {
  double distance = 0;                 ///< m; 0 where they touch or overlap
  Vector3 on_first = Vector3::Zero();  ///< in the world
  Vector3 on_second = Vector3::Zero();
  ObjectId first = kNoObject;  ///< the links
  ObjectId second = kNoObject;
};

class WorldGeometry : public WorldPart {
 public:
  using WorldPart::WorldPart;

  /// The nearest hit of a ray of length `max_distance`; the model `ignored_model` is ignored.
  std::optional<RayHit> cast_ray(const Vector3& origin, const Vector3& unit_direction, double max_distance,
                                 ObjectId ignored_model = kNoObject) const;
  std::vector<PlacedShape> shapes() const;
  /// The nearest points of the collision shapes of two sets of links, by the algorithm of Gilbert, Johnson and Keerthi
  /// (1988); none when they are farther apart than `limit`, m, or a set has no shapes. Meshes count as the physics sees
  /// them: as convex parts, or their triangles. Two links that are the same are not compared.
  std::optional<NearestPoints> nearest(const std::vector<ObjectId>& first, const std::vector<ObjectId>& second,
                                       double limit) const;
  /// The corners of the smallest box along the axes of `frame` with all collision shapes of some links; none if they
  /// have no shapes, or a plane.
  std::optional<std::pair<Vector3, Vector3>> bounds(const std::vector<ObjectId>& links, const Pose& frame) const;
  /// The lights of links, at their current poses.
  std::vector<Light> link_lights() const;
};

}  // namespace bubblesim
