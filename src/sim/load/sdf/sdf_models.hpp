// SPDX-License-Identifier: BSD-3-Clause
// SDFormat's <model>.
#pragma once

#include <sdf/Model.hh>

#include "bubblesim/scene.hpp"
#include "load/load_context.hpp"

namespace bubblesim {

/// `pose` is the pose of the model in the world.
ModelDescription read_model(const sdf::Model& model, const Pose& pose, LoadContext& reading);

}  // namespace bubblesim
