// SPDX-License-Identifier: BSD-3-Clause
// What files hold that is not simulated.
#pragma once

#include <sdf/Element.hh>
#include <string>

namespace bubblesim {

/// Warns of what stands directly in a world, a model or a link, with the path of that object (empty for the world).
void report_left_out(const sdf::ElementPtr& owner, const std::string& path);

}  // namespace bubblesim
