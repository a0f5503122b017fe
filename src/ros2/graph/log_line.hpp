// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <string>

namespace bubblesim::ros2 {

/// Writes a line about ROS 2 to the node's log, whole even if other threads write.
inline void log_line(const std::string& text) { std::fputs(("plugin 'ROS2Interface': " + text + "\n").c_str(), stderr); }

}  // namespace bubblesim::ros2
