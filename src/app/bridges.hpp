// SPDX-License-Identifier: BSD-3-Clause
// The bridges to ROS 1 and ROS 2: only the node knows both.
#pragma once

#include <memory>
#include <vector>

#include "bubblesim/node_bridge.hpp"
#include "options.hpp"

namespace bubblesim::app {

struct Node;

/// Makes the bridges that the options ask for. Takes ROS's arguments off the command line. Throws std::invalid_argument
/// if this build does not have them.
std::vector<std::unique_ptr<NodeBridge>> make_bridges(Node& node, int& argc, char** argv);

/// Whether this build has the bridge to ROS 2.
bool has_ros2();

/// The bridge to ROS 2, in a file of its own because a build may leave it out: then it throws std::invalid_argument.
std::unique_ptr<NodeBridge> make_ros2_bridge(int& argc, char** argv, NodeBridgeOptions options);

}  // namespace bubblesim::app
