// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <utility>

namespace bubblesim {

/// Service requests that wait for the thread that answers them. A service that calls another one answers requests
/// during its own call.
class RequestQueue {
 public:
  using Clock = std::chrono::steady_clock;

  /// `on_arrival` is called on the adding thread for each new request; it may be empty.
  explicit RequestQueue(std::function<void()> on_arrival) : on_arrival_(std::move(on_arrival)) {}

  /// Adds a function that answers a request of the service `owner`. Thread-safe.
  void add(std::function<void()> answer, std::uint64_t owner = 0);
  /// Drops the requests of a service. Thread-safe.
  void remove(std::uint64_t owner);
  /// Answers the pending requests, not those that arrive meanwhile: a busy client must not block the simulation.
  void serve();
  /// Answers requests as they arrive, until `done` returns true (returns true) or `deadline` has passed (returns
  /// false). Calls `done` at least every 20 ms, and at once after wake().
  bool serve_until(const std::function<bool()>& done, Clock::time_point deadline);
  /// Makes serve_until() call `done`. Thread-safe.
  void wake();

 private:
  struct Request {
    std::function<void()> answer;
    std::uint64_t owner;
  };

  const std::function<void()> on_arrival_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Request> requests_;
  int wakes_ = 0;
};

}  // namespace bubblesim
