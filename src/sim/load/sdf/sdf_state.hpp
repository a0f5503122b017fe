// SPDX-License-Identifier: BSD-3-Clause
// The <state> in which a world was saved: where Gazebo puts its models when it loads it.
#pragma once

#include <optional>
#include <sdf/World.hh>
#include <string>
#include <vector>

#include "bubblesim/scene.hpp"

namespace bubblesim {

/// The pose in the world that the state gives a model or light of this name.
std::optional<Pose> state_pose(const sdf::World& world, const std::string& kind, const std::string& name);

/// Puts models and their links where the state has them, and warns of what else it says.
void apply_state(const sdf::World& world, std::vector<ModelDescription>& models);

}  // namespace bubblesim
