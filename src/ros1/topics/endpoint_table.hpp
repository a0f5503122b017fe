// SPDX-License-Identifier: BSD-3-Clause
// Names and lookup of endpoints of all kinds.
#pragma once

#include <ros/names.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <unordered_map>

#include "bubblesim/messages/bridge.hpp"

namespace bubblesim {

template <class Endpoint>
using EndpointTable = std::unordered_map<messages::EndpointId, std::shared_ptr<Endpoint>>;

/// Throws std::invalid_argument with the endpoint's `kind` if the id is not in the table.
template <class Table>
auto find_endpoint(Table& table, messages::EndpointId id, const char* kind) {
  const auto found = table.find(id);
  if (found != table.end()) return found;
  throw std::invalid_argument("invalid object handle " + std::to_string(id) + ": no such " + kind +
                              ", or it was shut down");
}

/// The full name of a script's topic or service (`kind` for the error text), with remappings applied.
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
