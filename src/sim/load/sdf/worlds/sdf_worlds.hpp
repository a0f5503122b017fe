// SPDX-License-Identifier: BSD-3-Clause
// SDFormat's <world>.
#pragma once

#include <optional>

#include "bubblesim/scene.hpp"
#include "load/load_context.hpp"
#include "load/sdf/elements/sdf_element.hpp"

namespace bubblesim {

/// Reads a world into a scene, whose name and file are set. Returns into how many substeps <max_step_size> is divided;
/// empty: as its models need (substeps.hpp).
std::optional<double> read_world(const SdfElement& world, SceneDescription& scene, LoadContext& context);

}  // namespace bubblesim
