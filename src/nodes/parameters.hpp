// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <stdexcept>
#include <string>

namespace bubblesim {

/// The node's parameter `name`, or `fallback` when it is not set.
/// Throws std::invalid_argument if its value is of another type.
template <typename Value>
Value parameter(const ros::NodeHandle& node, const std::string& name, const Value& fallback) {
  Value value = fallback;
  if (node.hasParam(name) && !node.getParam(name, value))
    throw std::invalid_argument("the parameter " + node.resolveName(name) + " has a different type than its default");
  return value;
}

}  // namespace bubblesim
