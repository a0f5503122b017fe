// SPDX-License-Identifier: BSD-3-Clause
// SDFormat's <gripper>.
#pragma once

#include <string>

#include "bubblesim/scene.hpp"
#include "load/load_context.hpp"
#include "load/sdf/elements/sdf_element.hpp"

namespace bubblesim {

/// `inner` is the name of its model if that is nested, with "::" behind it.
GripperDescription read_gripper(const SdfElement& gripper, const std::string& inner);

/// Leaves out, with a warning, the grippers of a complete model that name links which it does not have, as Gazebo does.
void leave_out_broken_grippers(ModelDescription& model, LoadContext& context);

}  // namespace bubblesim
