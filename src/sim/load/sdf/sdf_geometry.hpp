// SPDX-License-Identifier: BSD-3-Clause
// SDFormat's <geometry>.
#pragma once

#include <optional>
#include <sdf/Geometry.hh>

#include "bubblesim/scene.hpp"
#include "load/load_context.hpp"

namespace bubblesim {

/// Files that it names lie as find_resource() tells. Nothing when it is empty. Throws MeshError, which says why, when
/// it cannot be had.
std::optional<Geometry> read_geometry(const sdf::Geometry& geometry, LoadContext& reading);

}  // namespace bubblesim
