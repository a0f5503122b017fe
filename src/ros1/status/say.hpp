// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <string>

namespace bubblesim {

/// A line about ROS in the node's log, in one piece whatever other threads write.
inline void say(const std::string& text) { std::fputs(("plugin 'ROSInterface': " + text + "\n").c_str(), stderr); }

}  // namespace bubblesim
