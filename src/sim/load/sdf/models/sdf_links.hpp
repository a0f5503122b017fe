// SPDX-License-Identifier: BSD-3-Clause
// SDFormat's <link>.
#pragma once

#include <string>

#include "bubblesim/scene.hpp"
#include "load/load_context.hpp"
#include "load/sdf/elements/sdf_element.hpp"
#include "load/sdf/models/frames.hpp"

namespace bubblesim {

/// `model_path` is the path of the model's object, `frames` are those of the model.
LinkDescription read_link(const SdfElement& link, const Frames& frames, const std::string& model_path, bool is_static,
                          LoadContext& context);

/// Replaces an inertia that a body cannot have, with a warning.
void repair_inertia(LinkDescription& link, const std::string& path, LoadContext& context);

/// Gives flat shapes of a visual a thickness.
void thicken(Geometry& geometry);

}  // namespace bubblesim
