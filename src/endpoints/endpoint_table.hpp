// SPDX-License-Identifier: BSD-3-Clause
// Lookup of endpoints of all kinds.
#pragma once

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

}  // namespace bubblesim
