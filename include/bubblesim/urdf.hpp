// SPDX-License-Identifier: BSD-3-Clause
// A model as URDF, for what reads the parameter robot_description: robot_state_publisher, RViz.
#pragma once

#include <string>

#include "bubblesim/scene.hpp"

namespace bubblesim {

/// The model's links and joints by their names. Each sensor is a link, too, fixed to the one that carries it, and that
/// of a camera carries another with z forward and x to the right: SENSOR_optical (REP 103). Shapes that URDF does not
/// know are left out, and so is the inertia of the root, which KDL would complain about.
/// Throws InvalidInput for a model that is no tree of links, or has joints that URDF does not know.
std::string to_urdf(const ModelDescription& model);

}  // namespace bubblesim
