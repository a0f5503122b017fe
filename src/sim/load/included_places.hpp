// SPDX-License-Identifier: BSD-3-Clause
// The places in the tree of models from other files than the scene's own. They refer to each other by numbers that are
// unique in their file only.
#pragma once

#include <string>
#include <vector>

#include "bubblesim/scene.hpp"

namespace bubblesim {

/// Gives the places of an included file's models numbers that no place of the scene has.
void renumber_places(const std::vector<ModelDescription*>& included, const SceneDescription& scene);

/// Gives an alias to those of the included objects that are below none of the others.
void set_top_alias(const std::vector<ModelDescription*>& included, const std::string& alias);

/// A model that is no object gives its alias and its child script to the object at its top.
void give_to_top(ModelDescription& model);

/// Renumbers the places of the scene's models from other files that have a number which is taken.
void separate_included_places(SceneDescription& scene);

}  // namespace bubblesim
