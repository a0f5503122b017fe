// SPDX-License-Identifier: BSD-3-Clause
// SDFormat's <surface>.
#pragma once

#include <string>

#include "bubblesim/scene.hpp"
#include "load/load_context.hpp"
#include "load/sdf/elements/sdf_element.hpp"

namespace bubblesim {

/// `path` is the path of the collision.
Surface read_surface(const SdfElement& collision, const std::string& path, LoadContext& context);

}  // namespace bubblesim
