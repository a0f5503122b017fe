// SPDX-License-Identifier: BSD-3-Clause
// Services that answer later, and calls that do not wait: the actions of ROS 2 are made of them.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "bubblesim/messages/bridge.hpp"

namespace bubblesim::messages {

/// Names a request to a server until it is answered.
using RequestNumber = std::int64_t;

/// Gets a request; the bytes are valid during the call.
using RequestCallback = std::function<void(RequestNumber number, WireView request)>;

/// What a bridge of ROS 2 offers besides Bridge. In ROS 1 a call keeps its connection until it is answered. All calls
/// come from the simulation's thread and return at once; callbacks are called on it during Bridge::process_input().
class LaterServices {
 public:
  virtual ~LaterServices() = default;

  /// Like Bridge::advertise_service(), but reply() answers a request, at any time.
  virtual EndpointId advertise_service_later(const std::string& name, const ServiceType& type,
                                             RequestCallback on_request) = 0;
  /// Does nothing for a request that is answered already.
  virtual void reply(EndpointId server, RequestNumber request, WireBuffer response) = 0;
  /// Whether a server gets the requests of a client, and its replies arrive.
  virtual bool service_is_ready(EndpointId client) const = 0;
  /// Sends a request; without a ready server it is lost. `on_response` gets the response if there is one.
  virtual void call_later(EndpointId client, WireBuffer request, MessageCallback on_response) = 0;
};

}  // namespace bubblesim::messages
