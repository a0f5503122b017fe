// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/callback_queue.h>

#include <array>
#include <atomic>
#include <thread>

#include "bubblesim/messages/wire.hpp"
#include "step_answers.hpp"

namespace bubblesim {

/// The answers of the services that step. They wait for the steps, so threads of their own make them: one may wait,
/// because only one request at a time is not refused at once, the other answers meanwhile.
class StepService {
 public:
  explicit StepService(StepAction action);
  ~StepService() { stop(); }
  StepService(const StepService&) = delete;
  StepService& operator=(const StepService&) = delete;

  messages::WireBuffer answer(const SteppingService& service, messages::WireView request) const;
  /// The requests that wait for a thread.
  ros::CallbackQueueInterface& queue() { return queue_; }
  /// Ends the threads, after their current answers.
  void stop();

 private:
  const StepAction action_;
  ros::CallbackQueue queue_;
  std::atomic<bool> ending_{false};
  std::array<std::thread, 2> threads_;
};

}  // namespace bubblesim
