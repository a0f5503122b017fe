// SPDX-License-Identifier: BSD-3-Clause
// Quality of service of a topic, as both versions of ROS can offer it.
#pragma once

#include <cstdint>
#include <optional>

namespace bubblesim::messages {

struct Qos {
  /// At most that many messages wait to be sent or delivered, the oldest are dropped first; 0: no limit.
  std::uint32_t depth = 10;
  /// Late subscribers get the messages that a publisher has kept: the last `depth`, in ROS 1 the last one ("latch"). In
  /// ROS 2, a subscriber with it only connects to publishers with it.
  bool transient_local = false;
  /// Messages that get lost are sent again. ROS 1 is always reliable. In ROS 2, a reliable subscriber only connects to
  /// reliable publishers.
  bool reliable = true;
  /// Of a subscriber, where messages go over TCP: publishers send each message at once and do not wait for a fuller
  /// packet. If a node has several subscribers of a topic, the value of the first one applies.
  bool tcp_no_delay = true;
  /// Of ROS 2 alone, s: messages that are older are not delivered.
  std::optional<double> lifespan = std::nullopt;
  /// Of ROS 2 alone, s: the longest time between two messages that a publisher offers or a subscriber asks for.
  std::optional<double> deadline = std::nullopt;
  /// Of a subscriber: messages that this node itself publishes are not delivered.
  bool ignore_own = false;
};

}  // namespace bubblesim::messages
