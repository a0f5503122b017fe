// SPDX-License-Identifier: BSD-3-Clause
// SDFormat's <joint>.
#pragma once

#include <optional>
#include <string>

#include "bubblesim/scene.hpp"
#include "load/load_context.hpp"
#include "load/sdf/elements/sdf_element.hpp"
#include "load/sdf/models/frames.hpp"

namespace bubblesim {

/// `model_path` is the path of the model's object, `frames` are those of the model. Empty when the joint cannot be
/// made: its type is unknown, which is reported, or a link of it does not exist, which is a warning, as in Gazebo.
std::optional<JointDescription> read_joint(const SdfElement& joint, const Frames& frames, const std::string& model_path,
                                           LoadContext& context);

}  // namespace bubblesim
