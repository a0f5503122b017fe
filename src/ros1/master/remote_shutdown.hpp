// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

namespace bubblesim {

/// Answers the method `shutdown` of this node's slave interface in roscpp's place, which would stop roscpp and leave
/// the process alive without it. `on_shutdown` gets the caller's name and reason, on a thread of roscpp's. To be called
/// before ros::start().
/// http://wiki.ros.org/ROS/Slave_API
void take_over_shutdown(std::function<void(const std::string& why)> on_shutdown);

}  // namespace bubblesim
