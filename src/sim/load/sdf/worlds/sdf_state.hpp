// SPDX-License-Identifier: BSD-3-Clause
// The <state> of a saved world, which gives the initial poses of its models.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bubblesim/scene.hpp"
#include "load/load_context.hpp"
#include "load/sdf/elements/sdf_element.hpp"

namespace bubblesim {

/// The pose, in the world, of a model or light of this name in the state.
std::optional<Pose> state_pose(const SdfElement& world, const std::string& kind, const std::string& name);

/// Sets the poses of models and links from the state, and warns about its other contents.
void apply_state(const SdfElement& world, std::vector<ModelDescription>& models, LoadContext& context);

}  // namespace bubblesim
