// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <mutex>
#include <string>

#include "traffic_diagnosis.hpp"

namespace bubblesim::ros2 {

/// Counts the traffic on a node's topics. Thread-safe.
class Traffic {
 public:
  void note_sent(std::size_t bytes, int subscribers);
  void note_received(std::size_t bytes);
  void note_dropped(const std::string& topic);
  TrafficReport take_report();

 private:
  std::mutex mutex_;
  TrafficReport report_;
};

}  // namespace bubblesim::ros2
