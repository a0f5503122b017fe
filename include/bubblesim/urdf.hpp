// SPDX-License-Identifier: BSD-3-Clause
// Converts a model to URDF, for the parameter robot_description: robot_state_publisher, RViz.
#pragma once

#include <string>

#include "bubblesim/scene.hpp"

namespace bubblesim {

/// Returns the model's links and joints under their names. Each sensor becomes a link, fixed to the link that carries
/// it. The link of a camera has a child link SENSOR_optical with z forward and x to the right (REP 103). Shapes that
/// URDF does not have are omitted, and so is the inertia of the root link, which KDL warns about. Throws InvalidInput
/// for a model that is not a tree of links, or has joints that URDF does not have.
std::string to_urdf(const ModelDescription& model);

}  // namespace bubblesim
