// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

namespace bubblesim {

/// What has gone over the node's topics since it was started, from what roscpp counts for each connection.
class TopicTraffic {
 public:
  struct Total {
    std::uint64_t messages = 0;
    std::uint64_t bytes = 0;
  };

  /// Adds what has come since the last call. Belongs to the master thread.
  void count();

  const Total& sent() const { return sent_; }  ///< given to roscpp's queues, once for each connection
  const Total& received() const { return received_; }
  std::uint64_t dropped() const {
    return dropped_;
  }  ///< received, then pushed out of a subscriber's queue by newer ones
  /// By topic, what was dropped between the last two calls of count().
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
  Counted outgoing_;  // as roscpp had them when they were counted last
  Counted incoming_;
};

}  // namespace bubblesim
