// SPDX-License-Identifier: BSD-3-Clause
// Whether a scene description can be simulated.
#pragma once

#include <string>
#include <vector>

#include "bubblesim/error.hpp"
#include "bubblesim/math.hpp"
#include "bubblesim/scene.hpp"

namespace bubblesim {

/// Everything in the scene that the physics could not take; empty when it is fit to run.
std::vector<Problem> check_scene(const SceneDescription& scene);
/// The same of a single model.
std::vector<Problem> check_model(const ModelDescription& model);

/// The hinge between two links of a model, either of which may be "world"; null when there is none.
const JointDescription* hinge_between(const ModelDescription& model, const std::string& one, const std::string& other);

/// Whether an inertia (xx, yy, zz and xy, xz, yz) is positive definite, and not by rounding only.
bool is_positive_definite(const Vector3& diagonal, const Vector3& products);

}  // namespace bubblesim
