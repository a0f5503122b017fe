// SPDX-License-Identifier: BSD-3-Clause
// <bubblesim:substeps>: into how many physics substeps a <max_step_size> is divided.
#pragma once

#include <optional>

#include "bubblesim/scene.hpp"
#include "load/load_context.hpp"
#include "load/sdf/elements/sdf_element.hpp"

namespace bubblesim {

/// The number of a world; empty for `auto`, 1 without the element. Another text is reported.
std::optional<double> read_substeps(const SdfElement& physics, LoadContext& context);

/// Divides the substep of a scene by `substeps`, or as its models need it when that is empty. Warns of the models that
/// need a shorter one.
void divide_substep(SceneDescription& scene, const std::optional<double>& substeps, LoadContext& context);

}  // namespace bubblesim
