// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/callback_queue.h>

#include <atomic>
#include <functional>
#include <thread>

#include "bubblesim/messages/wire.hpp"
#include "bubblesim/ros_bridge.hpp"

namespace bubblesim {

/// The answers of the service ~step. They wait for the steps, so a thread of their own makes them.
class StepService {
 public:
  using Action = std::function<StepAnswer(std::uint32_t steps)>;

  explicit StepService(Action action);
  ~StepService() { stop(); }
  StepService(const StepService&) = delete;
  StepService& operator=(const StepService&) = delete;

  messages::WireBuffer answer(messages::WireView request) const;
  /// The requests that wait for the thread.
  ros::CallbackQueueInterface& queue() { return queue_; }
  /// Ends the thread, after its current answer.
  void stop();

 private:
  const Action action_;
  ros::CallbackQueue queue_;
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

}  // namespace bubblesim
