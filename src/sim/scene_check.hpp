// SPDX-License-Identifier: BSD-3-Clause
// Whether a scene description can be simulated.
#pragma once

#include <vector>

#include "bubblesim/error.hpp"
#include "bubblesim/scene.hpp"

namespace bubblesim {

/// Everything in the scene that the physics could not take; empty when it is fit to run.
std::vector<Problem> check_scene(const SceneDescription& scene);
/// The same of a single model.
std::vector<Problem> check_model(const ModelDescription& model);

}  // namespace bubblesim
