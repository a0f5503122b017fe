// SPDX-License-Identifier: BSD-3-Clause
#include "topics/traffic.hpp"

namespace bubblesim::ros2 {

void Traffic::note_sent(std::size_t bytes, int subscribers) {
  const std::lock_guard lock(mutex_);
  report_.sent.messages += static_cast<std::uint64_t>(subscribers);
  report_.sent.bytes += bytes * static_cast<std::uint64_t>(subscribers);
}

void Traffic::note_received(std::size_t bytes) {
  const std::lock_guard lock(mutex_);
  ++report_.received.messages;
  report_.received.bytes += bytes;
}

void Traffic::note_dropped(const std::string& topic) {
  const std::lock_guard lock(mutex_);
  ++report_.dropped;
  ++report_.just_dropped[topic];
}

TrafficReport Traffic::take_report() {
  const std::lock_guard lock(mutex_);
  TrafficReport report = report_;
  report_.just_dropped.clear();
  return report;
}

}  // namespace bubblesim::ros2
