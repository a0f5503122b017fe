// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <thread>

#include "bubblesim/messages/wire.hpp"
#include "request_queue.hpp"
#include "step_answers.hpp"

namespace bubblesim {

/// The answers of the node's services that step. They wait for the steps, so threads of their own make them: one may
/// wait, because only one request at a time is not refused at once, the other answers meanwhile.
class StepService {
 public:
  /// `layout`: of the answers.
  StepService(StepAction action, messages::Layout layout);
  ~StepService() { stop(); }
  StepService(const StepService&) = delete;
  StepService& operator=(const StepService&) = delete;

  /// Throws messages::ServiceError for a request that is too short.
  messages::WireBuffer answer(const SteppingService& service, messages::WireView request) const {
    return service.answer(action_, request, layout_);
  }
  /// The requests that wait for a thread.
  const std::shared_ptr<RequestQueue>& queue() const { return queue_; }
  /// Ends the threads, after their current answers.
  void stop();

 private:
  const StepAction action_;
  const messages::Layout layout_;
  const std::shared_ptr<RequestQueue> queue_ = std::make_shared<RequestQueue>(nullptr);
  std::atomic<bool> ending_{false};
  std::array<std::thread, 2> threads_;
};

}  // namespace bubblesim
