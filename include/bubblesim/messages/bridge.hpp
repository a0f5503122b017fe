// SPDX-License-Identifier: BSD-3-Clause
// What child scripts ask of a message bridge. Scripts translate their values to wire bytes; a bridge only moves bytes,
// so it needs to know nothing of scripts, and scripts nothing of ROS. src/ros_bridge implements it.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "bubblesim/messages/message_type.hpp"
#include "bubblesim/messages/wire.hpp"

namespace bubblesim::messages {

/// Names a publisher or subscriber. Never used again after shutdown, so a stale one is noticed.
using EndpointId = std::int32_t;

/// Called on the simulation's thread while Bridge::drain() runs; the bytes are valid during the call.
using MessageCallback = std::function<void(WireView message)>;

struct BridgeTime {
  std::uint32_t sec = 0;
  std::uint32_t nanosec = 0;
};

/// All calls come from the simulation's thread and return at once: a bridge talks to its master on a thread of its own,
/// so an endpoint made while no master is reachable comes alive when one appears. Errors (unusable topic name, unknown
/// or shut-down id) are std::invalid_argument with a text for the script's author.
class Bridge {
 public:
  virtual ~Bridge() = default;

  /// `topic` follows ROS names: absolute `/a`, relative `a` (below the node's own name), `~a`. `type` must live as long
  /// as the bridge. At most `queue_size` messages wait to be sent or delivered, the oldest go first; 0 sets no limit.
  virtual EndpointId advertise(const std::string& topic, const MessageType& type, std::uint32_t queue_size,
                               bool latch) = 0;
  virtual EndpointId subscribe(const std::string& topic, const MessageType& type, std::uint32_t queue_size,
                               MessageCallback callback) = 0;
  /// Whether publish() would have any effect now: somebody listens, or the publisher latches.
  virtual bool wants_messages(EndpointId publisher) const = 0;
  virtual const MessageType& message_type(EndpointId endpoint) const = 0;
  virtual void publish(EndpointId publisher, WireBuffer message) = 0;
  virtual void shutdown_publisher(EndpointId publisher) = 0;
  virtual void shutdown_subscriber(EndpointId subscriber) = 0;

  /// Delivers what has arrived since the last call to the callbacks. A callback may call the bridge, shut its own
  /// subscriber down included; what it throws is passed on after the others have been served. A call from within a
  /// callback does nothing.
  virtual void drain() = 0;

  /// Time that messages should be stamped with: the simulation's when /use_sim_time is set, else the wall clock's.
  virtual BridgeTime now() const = 0;
};

}  // namespace bubblesim::messages
