// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "bubblesim/messages/translator.hpp"
#include "bubblesim/node_bridge.hpp"

namespace bubblesim::app {

/// A service of one side that is offered on the other. A call waits for its answer; meanwhile no messages are passed.
class PassedService {
 public:
  /// `from`: the side of the server. Throws std::invalid_argument if the types do not fit.
  PassedService(const std::string& name, NodeBridge& from, NodeBridge& to, const messages::ServiceType& from_type,
                const messages::ServiceType& to_type);
  ~PassedService();
  PassedService(const PassedService&) = delete;
  PassedService& operator=(const PassedService&) = delete;

 private:
  messages::WireBuffer call(messages::WireView request);

  NodeBridge& from_;
  NodeBridge& to_;
  const messages::Translator request_;
  const messages::Translator response_;
  const messages::EndpointId client_;
  const messages::EndpointId server_;
};

}  // namespace bubblesim::app
