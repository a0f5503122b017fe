// SPDX-License-Identifier: BSD-3-Clause
// SDFormat's <model>.
#pragma once

#include "bubblesim/scene.hpp"
#include "load/load_context.hpp"
#include "load/sdf/elements/sdf_element.hpp"
#include "load/sdf/models/frames.hpp"

namespace bubblesim {

/// Reads a <model>, or an <include> of URDF (documents.hpp), with the frames in it and its pose in the world.
ModelDescription read_model(const SdfElement& model, const Frames& frames, const Pose& pose, LoadContext& context);

}  // namespace bubblesim
