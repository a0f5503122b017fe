// SPDX-License-Identifier: BSD-3-Clause
#include "graph/rosout.hpp"

#include <chrono>
#include <cstdio>
#include <utility>

#include "bubblesim/messages/registry.hpp"
#include "graph/names.hpp"

namespace bubblesim::ros2 {
namespace {

/// As rcl's: late subscribers get the lines of the last ten seconds.
messages::Qos rosout_qos() {
  messages::Qos qos;
  qos.depth = 1000;
  qos.transient_local = true;
  qos.lifespan = 10.0;
  return qos;
}

TopicName rosout_topic() {
  return message_topic("/rosout", listed(messages::find_message("rcl_interfaces/Log", messages::RosVersion::kRos2),
                                         "rcl_interfaces/Log"));
}

}  // namespace

Rosout::Rosout(Participant& participant, std::string node)
    : node_(std::move(node)), writer_(participant, rosout_topic(), rosout_qos(), nullptr) {}

void Rosout::log(Level level, const std::string& text) {
  std::fputs(("plugin 'ROS2Interface': " + text + "\n").c_str(), stderr);  // whole even if other threads write
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(now);
  messages::WireBuffer message;
  message.begin(messages::Layout::kCdr);
  message.put(static_cast<std::int32_t>(seconds.count()));
  message.put(static_cast<std::uint32_t>(std::chrono::duration_cast<std::chrono::nanoseconds>(now - seconds).count()));
  message.put(static_cast<std::uint8_t>(level));
  message.put_string(node_);
  message.put_string(text);
  message.put_string("");  // file
  message.put_string("");  // function
  message.put(std::uint32_t{0});
  write(*writer_, message);
}

}  // namespace bubblesim::ros2
