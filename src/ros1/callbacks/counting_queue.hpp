// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/callback_queue_interface.h>

#include <atomic>
#include <boost/make_shared.hpp>
#include <memory>
#include <utility>

namespace bubblesim {

/// Number of messages or requests that wait for an endpoint's callback. Thread-safe.
using WaitingCount = std::shared_ptr<std::atomic<int>>;

/// Forwards the callbacks of one endpoint to the simulation thread's queue and counts the pending ones.
class CountingQueue final : public ros::CallbackQueueInterface {
 public:
  explicit CountingQueue(ros::CallbackQueueInterface& queue) : queue_(queue) {}

  void addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t owner) override {
    queue_.addCallback(boost::make_shared<Counted>(callback, waiting_), owner);
  }
  void removeByID(std::uint64_t owner) override { queue_.removeByID(owner); }

  const WaitingCount& waiting() const { return waiting_; }

 private:
  /// Pending until it is called or removed.
  class Counted final : public ros::CallbackInterface {
   public:
    Counted(ros::CallbackInterfacePtr callback, WaitingCount waiting)
        : callback_(std::move(callback)), waiting_(std::move(waiting)) {
      ++*waiting_;
    }
    ~Counted() override { end_waiting(); }

    CallResult call() override {
      end_waiting();
      return callback_->call();
    }
    bool ready() override { return callback_->ready(); }

   private:
    void end_waiting() {
      if (waiting_) --*std::exchange(waiting_, nullptr);
    }

    const ros::CallbackInterfacePtr callback_;
    WaitingCount waiting_;
  };

  ros::CallbackQueueInterface& queue_;
  const WaitingCount waiting_ = std::make_shared<std::atomic<int>>(0);
};

}  // namespace bubblesim
