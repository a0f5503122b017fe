// SPDX-License-Identifier: BSD-3-Clause
// For builds with ROS 2.
#include <utility>

#include "bridges.hpp"
#include "bubblesim/ros2_bridge.hpp"

namespace bubblesim::app {

bool has_ros2() { return true; }

std::unique_ptr<NodeBridge> make_ros2_bridge(int& argc, char** argv, NodeBridgeOptions options) {
  return std::make_unique<Ros2Bridge>(argc, argv, std::move(options));
}

}  // namespace bubblesim::app
