// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/callback_queue.h>

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <utility>

namespace bubblesim {

/// Lets the simulation's thread sleep until something has come for it.
class Arrivals {
 public:
  /// From any thread.
  void note() {
    {
      const std::lock_guard lock(mutex_);
      some_ = true;
    }
    changed_.notify_all();
  }

  /// Returns as soon as something was noted since the last call, or when `timeout` has passed.
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

/// Notes what comes into it.
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
