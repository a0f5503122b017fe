// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/callback_queue.h>

#include <functional>
#include <memory>
#include <mutex>
#include <utility>

namespace bubblesim {

/// Notifies the simulation thread that input has arrived. Thread-safe.
class Arrivals {
 public:
  explicit Arrivals(std::function<void()> on_arrival) : on_arrival_(std::move(on_arrival)) {}

  void note() {
    const std::lock_guard lock(mutex_);
    if (on_arrival_) on_arrival_();
  }
  /// From here on, note() does nothing: roscpp's threads may outlive the simulation.
  void silence() {
    const std::lock_guard lock(mutex_);
    on_arrival_ = nullptr;
  }

 private:
  std::mutex mutex_;
  std::function<void()> on_arrival_;
};

/// A queue that calls note() for each new callback.
class NotifyingQueue final : public ros::CallbackQueue {
 public:
  explicit NotifyingQueue(std::shared_ptr<Arrivals> arrivals) : arrivals_(std::move(arrivals)) {}

  void addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t owner) override {
    ros::CallbackQueue::addCallback(callback, owner);
    arrivals_->note();
  }

 private:
  const std::shared_ptr<Arrivals> arrivals_;
};

}  // namespace bubblesim
