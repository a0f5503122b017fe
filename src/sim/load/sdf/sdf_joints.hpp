// SPDX-License-Identifier: BSD-3-Clause
// SDFormat's <joint>.
#pragma once

#include <sdf/Joint.hh>
#include <string>

#include "bubblesim/scene.hpp"
#include "load/load_context.hpp"

namespace bubblesim {

/// `model_path` is the path of the model's object.
JointDescription read_joint(const sdf::Joint& joint, const std::string& model_path, LoadContext& reading);

}  // namespace bubblesim
