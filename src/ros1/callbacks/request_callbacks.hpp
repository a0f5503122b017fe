// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/callback_queue_interface.h>

#include <cstdint>
#include <memory>
#include <utility>

#include "request_queue.hpp"

namespace bubblesim {

/// Puts roscpp's service requests into a RequestQueue. roscpp's CallbackQueue is not suitable: a service that calls
/// another service answers requests during its own call, and there roscpp does not return callbacks that the outer call
/// has taken, and does not survive a service that is shut down meanwhile (its lock is not recursive).
class RequestCallbacks final : public ros::CallbackQueueInterface {
 public:
  explicit RequestCallbacks(std::shared_ptr<RequestQueue> queue) : queue_(std::move(queue)) {}

  void addCallback(const ros::CallbackInterfacePtr& request, std::uint64_t owner) override {
    queue_->add([request] { request->call(); }, owner);
  }
  void removeByID(std::uint64_t owner) override { queue_->remove(owner); }

 private:
  const std::shared_ptr<RequestQueue> queue_;
};

}  // namespace bubblesim
