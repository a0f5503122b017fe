// SPDX-License-Identifier: BSD-3-Clause
// What the physics needs of a model besides its description, made once and shared by all worlds that have the model.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "bubblesim/error.hpp"
#include "bubblesim/scene.hpp"
#include "physics/convex/collision_mesh.hpp"

namespace bubblesim {

struct PreparedModel {
  std::shared_ptr<const ModelDescription> description;
  std::uint64_t added_hash = 0;  // of its description when it was added to a world; 0 when it is of the scene
  bool is_prop = false;          // nothing commands or observes it: it may sleep when it is at rest
  /// One for each collision shape, in the order of the links; null for shapes that ODE has itself.
  std::vector<std::shared_ptr<const CollisionMesh>> meshes;
};

/// Whether ODE simulates it as a sphere.
bool is_ball(const Ellipsoid& ellipsoid);

/// Prepares a checked model. Adds the simplification of meshes to `warnings`, unless it is null.
std::shared_ptr<PreparedModel> prepare_model(std::shared_ptr<const ModelDescription> description,
                                             std::vector<Problem>* warnings);

}  // namespace bubblesim
