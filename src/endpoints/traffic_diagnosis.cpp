// SPDX-License-Identifier: BSD-3-Clause
#include "traffic_diagnosis.hpp"

namespace bubblesim {

Diagnosis judge(const TrafficReport& report) {
  Diagnosis found;
  found.message = "nothing dropped";
  for (const auto& [topic, count] : report.just_dropped) {
    found.merge(Diagnosis::kWarn,
                topic + ": " + std::to_string(count) + " messages dropped, the subscriber's queue is full");
  }
  found.values = {
      {"Messages sent", std::to_string(report.sent.messages)},
      {"Bytes sent", std::to_string(report.sent.bytes)},
      {"Messages received", std::to_string(report.received.messages)},
      {"Bytes received", std::to_string(report.received.bytes)},
      {"Messages dropped", std::to_string(report.dropped)},
  };
  return found;
}

}  // namespace bubblesim
