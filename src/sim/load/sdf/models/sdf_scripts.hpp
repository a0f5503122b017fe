// SPDX-License-Identifier: BSD-3-Clause
// The <script> of an actor, and <bubblesim:script> of a model.
#pragma once

#include <functional>

#include "bubblesim/scene.hpp"
#include "load/load_context.hpp"
#include "load/sdf/elements/sdf_element.hpp"

namespace bubblesim {

/// Returns the pose in the world for that of a waypoint in the file.
using PlaceWaypoint = std::function<Pose(const Pose& waypoint)>;

/// Leaves out trajectories without waypoints.
MotionScript read_script(const SdfElement& script, const PlaceWaypoint& place, LoadContext& context);

}  // namespace bubblesim
