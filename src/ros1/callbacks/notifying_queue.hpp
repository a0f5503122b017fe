// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/callback_queue.h>

#include <cstdint>
#include <memory>
#include <utility>

#include "arrivals.hpp"

namespace bubblesim {

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
