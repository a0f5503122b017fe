// SPDX-License-Identifier: BSD-3-Clause
// SDFormat's <geometry>.
#pragma once

#include <optional>

#include "bubblesim/scene.hpp"
#include "load/load_context.hpp"
#include "load/sdf/elements/sdf_element.hpp"

namespace bubblesim {

/// Reads a geometry; its files are searched as by find_resource(). Empty when the geometry is empty. Throws MeshError,
/// with the reason, when it cannot be read.
std::optional<Geometry> read_geometry(const SdfElement& geometry, LoadContext& context);

}  // namespace bubblesim
