// SPDX-License-Identifier: BSD-3-Clause
// Checks whether a scene description can be simulated.
#pragma once

#include <string>
#include <vector>

#include "bubblesim/error.hpp"
#include "bubblesim/math.hpp"
#include "bubblesim/scene.hpp"

namespace bubblesim {

/// Returns all problems of the scene; empty when it can be simulated.
std::vector<Problem> check_scene(const SceneDescription& scene);
/// Returns all problems of a single model.
std::vector<Problem> check_model(const ModelDescription& model);

/// The hinge between two links of a model, either of which may be "world"; null when there is none.
const JointDescription* hinge_between(const ModelDescription& model, const std::string& one, const std::string& other);

/// Whether an inertia (xx, yy, zz and xy, xz, yz) is positive definite, not only because of rounding.
bool is_positive_definite(const Vector3& diagonal, const Vector3& products);

}  // namespace bubblesim
