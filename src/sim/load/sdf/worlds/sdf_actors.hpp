// SPDX-License-Identifier: BSD-3-Clause
// SDFormat's <actor>.
#pragma once

#include "bubblesim/scene.hpp"
#include "load/load_context.hpp"
#include "load/sdf/elements/sdf_element.hpp"

namespace bubblesim {

/// A person as a static model: an upright capsule that the script moves. The skin and its animation are not read, and
/// links and joints of an actor are ignored. The person stands upright: of a pose, the position and the yaw count. An
/// origin at a height of 0.5 m or more is that of the hips, as of many skins, and the feet are 1 m below it.
ModelDescription read_actor(const SdfElement& actor, LoadContext& context);

}  // namespace bubblesim
