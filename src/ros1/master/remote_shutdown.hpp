// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

namespace bubblesim {

/// Replaces roscpp's method `shutdown` of this node's slave interface, which would stop roscpp and leave the process
/// running without it. `on_shutdown` gets the caller's name and reason, on a roscpp thread. Call it before
/// ros::start(). http://wiki.ros.org/ROS/Slave_API
void take_over_shutdown(std::function<void(const std::string& why)> on_shutdown);

}  // namespace bubblesim
