// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace bubblesim::ros2 {

/// How far nodes are looked for.
enum class Range { kOff, kLocalhost, kSubnet };

/// What the environment sets for ROS 2.
struct Environment {
  int domain = 0;                   ///< ROS_DOMAIN_ID
  Range range = Range::kLocalhost;  ///< ROS_AUTOMATIC_DISCOVERY_RANGE, ROS_LOCALHOST_ONLY
  std::vector<std::string> peers;   ///< ROS_STATIC_PEERS: hosts that are looked for besides, names or IPv4 addresses
  std::size_t gid_size = 16;        ///< bytes of an endpoint's id in ros_discovery_info: 24 up to Humble
};

/// Throws std::invalid_argument for a value that ROS 2 does not take.
Environment read_environment();

}  // namespace bubblesim::ros2
