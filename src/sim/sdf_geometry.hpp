// SPDX-License-Identifier: BSD-3-Clause
// SDFormat's <geometry>.
#pragma once

#include <optional>
#include <sdf/Geometry.hh>

#include "bubblesim/scene.hpp"

namespace bubblesim {

/// Nothing for shapes that are not supported.
std::optional<Geometry> read_geometry(const sdf::Geometry& geometry);

}  // namespace bubblesim
