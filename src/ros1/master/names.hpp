// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/names.h>

#include <stdexcept>
#include <string>

namespace bubblesim {

/// The full name of a script's topic, service or parameter (`kind` for the error text), with remappings applied.
inline std::string resolve_name(const std::string& name, const std::string& kind) {
  std::string error;
  if (name.empty()) {
    error = "it is empty";
  } else if (ros::names::validate(name, error)) {
    const bool below_node = name[0] != '/' && name[0] != '~';
    std::string resolved = ros::names::resolve(below_node ? "~" + name : name);
    if (resolved.size() > 1) return resolved;
    error = "it has no name part";
  }
  throw std::invalid_argument("invalid " + kind + " name '" + name + "': " + error);
}

}  // namespace bubblesim
