// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/console.h>
#include <ros/init.h>
#include <ros/node_handle.h>

#include <stdexcept>

namespace bubblesim {

/// Runs a node of the class `Node` under `name` until it is told to stop, and returns the process's exit code: 2 when a
/// parameter cannot be used, which the log tells.
template <typename Node>
int run_node(int argc, char** argv, const char* name) {
  ros::init(argc, argv, name);
  const ros::NodeHandle alive;  // with the last handle the log ends, too
  try {
    Node node;
    ros::spin();
  } catch (const std::invalid_argument& error) {
    ROS_FATAL("a parameter of %s cannot be used: %s", ros::this_node::getName().c_str(), error.what());
    return 2;
  }
  return 0;
}

}  // namespace bubblesim
