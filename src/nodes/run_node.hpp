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

/// Starts roscpp after ros::init(): listens on the advertised address only, with the limits for peers.
inline ros::NodeHandle start_node() {
  check_peer_limits();
  limit_peer_lines();
  const AdvertisedAddress alone;
  return {};
}

/// Runs a node of class `Node` under `name` until shutdown and returns the process's exit code: 2 for an invalid
/// parameter, which it logs.
template <typename Node>
int run_node(int argc, char** argv, const char* name) {
  stay_on_this_machine(argc, argv);
  ros::init(argc, argv, name);
  const ros::NodeHandle alive = start_node();  // the last handle also ends the log
  try {
    Node node;
    ros::spin();
  } catch (const std::invalid_argument& error) {
    ROS_FATAL("invalid parameter of %s: %s", ros::this_node::getName().c_str(), error.what());
    return 2;
  }
  return 0;
}

}  // namespace bubblesim
