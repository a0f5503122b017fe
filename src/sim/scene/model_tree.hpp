// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bubblesim/scene.hpp"
#include "bubblesim/scene_tree.hpp"

namespace bubblesim {

/// Adds a model and its objects to the tree; returns the handle of the model.
ObjectId enter_model(SceneTree& tree, const ModelDescription& model);

}  // namespace bubblesim
