// SPDX-License-Identifier: BSD-3-Clause
// SDFormat's <geometry>.
#pragma once

#include <optional>
#include <sdf/Geometry.hh>

#include "bubblesim/scene.hpp"
#include "load/scene_reading.hpp"

namespace bubblesim {

/// Files that it names lie as find_resource() tells. Nothing when it is empty. Throws MeshError, which says why, when
/// it cannot be had.
std::optional<Geometry> read_geometry(const sdf::Geometry& geometry, SceneReading& reading);

}  // namespace bubblesim
