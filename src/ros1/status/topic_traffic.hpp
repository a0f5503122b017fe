// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

namespace bubblesim {

/// Traffic on the node's topics since its start, from roscpp's counters of each connection.
class TopicTraffic {
 public:
  struct Total {
    std::uint64_t messages = 0;
    std::uint64_t bytes = 0;
  };

  /// Adds the traffic since the last call. Used by the master thread only.
  void count();

  const Total& sent() const { return sent_; }  ///< passed to roscpp's queues, once per connection
  const Total& received() const { return received_; }
  std::uint64_t dropped() const {
    return dropped_;
  }  ///< received, then replaced by newer ones in a full subscriber queue
  /// By topic, the number dropped between the last two calls of count().
  const std::map<std::string, std::uint64_t>& just_dropped() const { return just_dropped_; }

 private:
  struct Counts {
    std::uint32_t bytes = 0;
    std::uint32_t messages = 0;
    std::uint32_t dropped = 0;
  };
  using Connection = std::pair<std::string, int>;  // topic, roscpp's number
  using Counted = std::map<Connection, Counts>;

  Total sent_;
  Total received_;
  std::uint64_t dropped_ = 0;
  std::map<std::string, std::uint64_t> just_dropped_;
  Counted outgoing_;  // roscpp's counters at the last count
  Counted incoming_;
};

}  // namespace bubblesim
