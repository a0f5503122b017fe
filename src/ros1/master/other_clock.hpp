// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace bubblesim {

/// Why this simulator cannot use a master: another one, Gazebo or `rosbag play --clock` publishes its time on `topic`
/// there, and nodes would receive two times. Empty if there is none that takes connections. Asks the master.
std::string other_time_on(const std::string& topic);

}  // namespace bubblesim
