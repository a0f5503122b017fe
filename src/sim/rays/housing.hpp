// SPDX-License-Identifier: BSD-3-Clause
// Finds the shapes around the sensors of a model, which their rays must ignore quickly.
#pragma once

#include <vector>

#include "bubblesim/scene.hpp"
#include "bubblesim/world.hpp"

namespace bubblesim::rays {

/// The positions of a model's sensors, in the world.
std::vector<Vector3> sensor_positions(const World& world, ObjectId model);

/// Whether a sensor is inside a shape at `pose` in the world; inside its bounding box in case of a mesh.
bool houses(const Geometry& geometry, const Pose& pose, const std::vector<Vector3>& sensors);

}  // namespace bubblesim::rays
