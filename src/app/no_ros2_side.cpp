// SPDX-License-Identifier: BSD-3-Clause
// For builds without ROS 2.
#include <stdexcept>

#include "bridges.hpp"

namespace bubblesim::app {

bool has_ros2() { return false; }

std::unique_ptr<NodeBridge> make_ros2_bridge(int&, char**, NodeBridgeOptions) {
  throw std::invalid_argument("--ros: this build has no ROS 2; build it with: scripts/setup --with ros2");
}

}  // namespace bubblesim::app
