// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <string>

namespace bubblesim {

/// Writes a line about ROS to the node's log, whole even if other threads write.
inline void log_line(const std::string& text) { std::fputs(("plugin 'ROSInterface': " + text + "\n").c_str(), stderr); }

}  // namespace bubblesim
