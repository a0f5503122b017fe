// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "traffic_diagnosis.hpp"

namespace bubblesim {

/// Counts the traffic on the node's topics, from roscpp's counters of each connection. Used by the master thread only.
class TopicTraffic {
 public:
  /// Sent is what was passed to roscpp's queues.
  const TrafficReport& take_report();

 private:
  struct Counts {
    std::uint32_t bytes = 0;
    std::uint32_t messages = 0;
    std::uint32_t dropped = 0;
  };
  using Connection = std::pair<std::string, int>;  // topic, roscpp's number
  using Counted = std::map<Connection, Counts>;

  TrafficReport report_;
  Counted outgoing_;  // roscpp's counters at the last count
  Counted incoming_;
};

}  // namespace bubblesim
