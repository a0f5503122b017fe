// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>

#include "bubblesim/messages/wire.hpp"
#include "dds/participant.hpp"

namespace bubblesim::ros2 {

/// The messages of one publisher that wait to be written.
struct Outgoing {
  Writer& writer;
  const std::size_t depth;                    ///< 0: no limit
  std::deque<messages::WireBuffer> messages;  ///< guarded by the outbox
};

/// The messages of all publishers, in the order in which they were published. A thread of its own writes them: to hand
/// a message to the network takes longer than to encode it, and evicts the simulation from the caches.
class Outbox {
 public:
  Outbox();
  ~Outbox();
  Outbox(const Outbox&) = delete;
  Outbox& operator=(const Outbox&) = delete;

  /// Waits a moment for a place if `depth` messages of the publisher wait, then drops the oldest of them.
  void add(const std::shared_ptr<Outgoing>& outgoing, messages::WireBuffer message);
  /// Waits a moment until all messages are written: what is sent without the outbox next comes after them.
  void settle();
  /// Waits until the messages of the publisher are written, or until `end`.
  void wait_until_written(const Outgoing& outgoing, std::chrono::steady_clock::time_point end);
  /// Drops the messages of the publisher that are not written. Its writer is not used any more.
  void drop(const Outgoing& outgoing);

 private:
  void run();

  std::mutex mutex_;
  std::condition_variable added_;
  std::condition_variable written_;
  std::deque<std::shared_ptr<Outgoing>> order_;  // an entry for each message; guarded, like what follows
  const Outgoing* in_hand_ = nullptr;            // whose message is being written
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace bubblesim::ros2
