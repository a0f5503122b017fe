// SPDX-License-Identifier: BSD-3-Clause
// Reports elements that are not simulated.
#pragma once

#include <sdf/Element.hh>
#include <string>

#include "load/load_context.hpp"

namespace bubblesim {

/// Warns about child elements of a world, a model or a link; `path` is the path of that object (empty for the world).
void report_left_out(const sdf::ElementPtr& owner, const std::string& path, LoadContext& reading);

}  // namespace bubblesim
