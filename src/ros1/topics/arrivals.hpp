// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/callback_queue.h>

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <utility>

namespace bubblesim {

/// Lets the simulation thread sleep until input arrives.
class Arrivals {
 public:
  /// Thread-safe.
  void note() {
    {
      const std::lock_guard lock(mutex_);
      some_ = true;
    }
    changed_.notify_all();
  }

  /// Returns after a call of note() since the last call, or at `timeout`.
  void wait(std::chrono::duration<double> timeout) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, timeout, [this] { return some_; });
    some_ = false;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool some_ = false;
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
