// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace bubblesim::ros2 {

/// What the environment says about ROS 2.
struct Environment {
  int domain = 0;              ///< ROS_DOMAIN_ID
  std::size_t gid_size = 16;   ///< bytes of an endpoint's id in ros_discovery_info: 24 up to Humble
};

/// Throws std::invalid_argument for a value that ROS 2 does not take.
Environment read_environment();

}  // namespace bubblesim::ros2
