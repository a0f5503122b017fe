// SPDX-License-Identifier: BSD-3-Clause
// SDFormat's <surface>.
#pragma once

#include <sdf/Element.hh>
#include <string>

#include "bubblesim/scene.hpp"
#include "load/load_context.hpp"

namespace bubblesim {

/// `path` is the path of the collision.
Surface read_surface(const sdf::ElementPtr& collision, const std::string& path, LoadContext& reading);

}  // namespace bubblesim
