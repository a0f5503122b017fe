// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "bubblesim/node_graph.hpp"

namespace bubblesim {

/// Reads what other nodes publish, receive and offer. For the master thread.
class GraphReader {
 public:
  /// Empty without a master. Asks each service once for its type.
  NodeGraph read();

 private:
  std::map<std::string, std::string> service_types_;
};

}  // namespace bubblesim
