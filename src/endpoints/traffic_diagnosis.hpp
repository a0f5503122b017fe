// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "diagnosis.hpp"

namespace bubblesim {

/// Traffic on the topics of a node since its start.
struct TrafficReport {
  struct Total {
    std::uint64_t messages = 0;
    std::uint64_t bytes = 0;
  };

  Total sent;  ///< once for each subscriber
  Total received;
  std::uint64_t dropped = 0;                          ///< received, then replaced by newer ones in a full queue
  std::map<std::string, std::uint64_t> just_dropped;  ///< by topic, since the last report
};

Diagnosis judge(const TrafficReport& report);

}  // namespace bubblesim
