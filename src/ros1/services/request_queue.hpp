// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/callback_queue_interface.h>

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>

#include "callbacks/arrivals.hpp"

namespace bubblesim {

/// Service requests that wait for the simulation thread. roscpp's CallbackQueue is not suitable: a service that calls
/// another service answers requests during its own call, and there roscpp does not return callbacks that the outer call
/// has taken, and does not survive a service that is shut down meanwhile (its lock is not recursive).
class RequestQueue final : public ros::CallbackQueueInterface {
 public:
  using Clock = std::chrono::steady_clock;

  explicit RequestQueue(std::shared_ptr<Arrivals> arrivals) : arrivals_(std::move(arrivals)) {}

  void addCallback(const ros::CallbackInterfacePtr& request, std::uint64_t owner) override;
  void removeByID(std::uint64_t owner) override;

  /// Answers the pending requests, not those that arrive meanwhile: a busy client must not block the simulation.
  void serve();

  /// Answers requests as they arrive, until `done` returns true (returns true) or `deadline` has passed (returns
  /// false). Calls `done` at least every 20 ms, and at once after wake().
  bool serve_until(const std::function<bool()>& done, Clock::time_point deadline);

  /// Makes serve_until() call `done`. Thread-safe.
  void wake();

 private:
  struct Request {
    ros::CallbackInterfacePtr callback;
    std::uint64_t owner;
  };

  const std::shared_ptr<Arrivals> arrivals_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Request> requests_;
  bool woken_ = false;
};

}  // namespace bubblesim
