// SPDX-License-Identifier: BSD-3-Clause
// Paths of V4.1 and earlier as those of later versions: dummies with the points of the path in their custom data.
#pragma once

#include <map>
#include <string>

#include "load/ttt/scene_file.hpp"

namespace bubblesim::ttt {

/// The blocks `PATH`, the points on the curve, and `PATHCTRLPTS`, the control points: x y z and a quaternion x y z w
/// each, as doubles. A closed path ends with its first point. Empty for a path without points.
std::map<std::string, std::string> data_of(const Path& path);

}  // namespace bubblesim::ttt
