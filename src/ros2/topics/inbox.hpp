// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "arrivals.hpp"
#include "bubblesim/messages/bridge.hpp"
#include "callback_guard.hpp"
#include "topics/traffic.hpp"

namespace bubblesim::ros2 {

/// The messages of one subscriber that wait for the simulation's thread.
struct Mailbox {
  std::string topic;
  std::size_t depth = 0;                                ///< 0: no limit
  std::deque<std::vector<std::uint8_t>> messages;       ///< guarded by the inbox
  bool aside = false;                                   ///< of the simulation's thread: deliver nothing
  std::shared_ptr<messages::MessageCallback> callback;  ///< of the simulation's thread; null: shut down
};

/// The messages of all subscribers, in the order in which they arrived.
class Inbox {
 public:
  Inbox(Arrivals& arrivals, Traffic& traffic) : arrivals_(arrivals), traffic_(traffic) {}

  /// On any thread. Drops the oldest message of a full mailbox.
  void add(const std::shared_ptr<Mailbox>& mailbox, std::vector<std::uint8_t> message);
  /// Whether messages wait for this mailbox. Thread-safe.
  bool has(const Mailbox& mailbox) const;
  /// Calls the callbacks for what has arrived before the call.
  void deliver(CallbackGuard& guard);

 private:
  Arrivals& arrivals_;
  Traffic& traffic_;
  mutable std::mutex mutex_;
  std::deque<std::shared_ptr<Mailbox>> order_;  // an entry for each message
};

}  // namespace bubblesim::ros2
