// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/console.h>
#include <ros/init.h>
#include <ros/node_handle.h>

#include <stdexcept>

#include "advertised_address.hpp"
#include "peer_limits.hpp"
#include "peer_lines.hpp"

namespace bubblesim {

/// Starts roscpp after ros::init(): with ports on the advertised address alone, and within the limits for peers.
inline ros::NodeHandle start_node() {
  check_peer_limits();
  limit_peer_lines();
  const AdvertisedAddress alone;
  return {};
}

/// Runs a node of the class `Node` under `name` until it is told to stop, and returns the process's exit code: 2 when a
/// parameter cannot be used, which the log tells.
template <typename Node>
int run_node(int argc, char** argv, const char* name) {
  ros::init(argc, argv, name);
  const ros::NodeHandle alive = start_node();  // with the last handle the log ends, too
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
