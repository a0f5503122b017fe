// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>

#include "topics/inbox.hpp"

namespace bubblesim::ros2 {

/// Service requests that wait for the thread that answers them.
class RequestQueue {
 public:
  using Clock = std::chrono::steady_clock;

  /// `arrivals` may be nullptr.
  explicit RequestQueue(Arrivals* arrivals) : arrivals_(arrivals) {}

  /// Adds a function that answers a request. Thread-safe.
  void add(std::function<void()> answer);
  /// Answers the pending requests, not those that arrive meanwhile: a busy client must not block the simulation.
  void serve();
  /// Answers requests as they arrive, until `done` returns true (returns true) or `deadline` has passed (returns
  /// false). Calls `done` at least every 20 ms, and at once after wake().
  bool serve_until(const std::function<bool()>& done, Clock::time_point deadline);
  /// Makes serve_until() call `done`. Thread-safe.
  void wake();

 private:
  Arrivals* const arrivals_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> requests_;
  int wakes_ = 0;
};

}  // namespace bubblesim::ros2
