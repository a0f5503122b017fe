// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <set>
#include <string>

namespace bubblesim {

/// Topics that this node is connected to -> the nodes that they come from, by their URIs.
std::map<std::string, std::set<std::string>> connected_publishers();

}  // namespace bubblesim
