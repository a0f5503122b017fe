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

#include "topics/arrivals.hpp"

namespace bubblesim {

/// Service requests that wait for the simulation's thread. roscpp's own CallbackQueue will not do: a service that calls
/// a service answers requests while it is being called itself, and there roscpp neither hands out what the outer round
/// has taken, nor survives a service that is shut down meanwhile (its lock is not recursive).
class RequestQueue final : public ros::CallbackQueueInterface {
 public:
  using Clock = std::chrono::steady_clock;

  explicit RequestQueue(std::shared_ptr<Arrivals> arrivals) : arrivals_(std::move(arrivals)) {}

  void addCallback(const ros::CallbackInterfacePtr& request, std::uint64_t owner) override;
  void removeByID(std::uint64_t owner) override;

  /// Answers the requests that are there now, not those that come meanwhile: a busy client must not stop time.
  void serve();

  /// Answers requests as they come, until `done` holds (true) or `deadline` has passed (false). `done` is asked at
  /// least every 20 ms, and at once after wake().
  bool serve_until(const std::function<bool()>& done, Clock::time_point deadline);

  /// From any thread: what serve_until() waits for may have come.
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
