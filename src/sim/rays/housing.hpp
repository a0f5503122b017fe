// SPDX-License-Identifier: BSD-3-Clause
// Finds the shapes around the sensors of a model, which their rays must ignore quickly.
#pragma once

#include <vector>

#include "bubblesim/scene.hpp"

namespace bubblesim::rays {

/// The initial positions of the sensors of a model's links, in the model's frame.
std::vector<Vector3> sensor_positions(const ModelDescription& model);

/// Whether a sensor is inside a shape at `pose`, in the frame of the positions; inside its bounding box in case of a
/// mesh.
bool houses(const Geometry& geometry, const Pose& pose, const std::vector<Vector3>& sensors);

}  // namespace bubblesim::rays
