// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <set>
#include <string>

namespace bubblesim {

/// Connected topics -> the URIs of their publishers.
std::map<std::string, std::set<std::string>> connected_publishers();

}  // namespace bubblesim
