// SPDX-License-Identifier: BSD-3-Clause
// The models of a world and their descriptions.
#pragma once

#include <vector>

#include "bubblesim/error.hpp"
#include "bubblesim/scene.hpp"
#include "bubblesim/scene_tree.hpp"
#include "bubblesim/world_part.hpp"

namespace bubblesim {

class WorldModels : public WorldPart {
 public:
  using WorldPart::WorldPart;

  /// Adds a model at the pose of its description. Throws SceneError with all problems of the model, also when its name
  /// is taken, and Diverged after a divergence. Adds warnings to `warnings`, unless it is null.
  ObjectId add(ModelDescription model, std::vector<Problem>* warnings = nullptr);
  /// Adds several models at once, whose parts may have places (TreePlace) below each other's. Throws likewise; nothing
  /// is added then.
  std::vector<ObjectId> add(std::vector<ModelDescription> models, std::vector<Problem>* warnings = nullptr);
  /// Removes a model with all its objects; their handles become invalid. Throws InvalidInput for objects of other kinds
  /// and for nested models, and Diverged after a divergence, unless the model is one of World::diverged_models().
  void remove(ObjectId model);
  /// Throws what remove() would throw.
  void check_removable(ObjectId model) const;
  /// The description of the object's model.
  const ModelDescription& description(ObjectId object) const;
  /// Throws WrongObject for objects of other kinds.
  const SensorDescription& sensor_description(ObjectId sensor) const;
};

}  // namespace bubblesim
