// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <thread>

#include "bubblesim/messages/wire.hpp"
#include "bubblesim/node_bridge.hpp"
#include "request_queue.hpp"

namespace bubblesim {

/// The answers of the node's service to step, bubblesim_msgs/Step. They wait for the steps, so threads of their own
/// make them: one may wait, because only one request at a time is not refused at once, the other answers meanwhile.
class StepService {
 public:
  using Action = std::function<StepAnswer(std::uint32_t steps)>;

  /// `layout`: of the answers.
  StepService(Action action, messages::Layout layout);
  ~StepService() { stop(); }
  StepService(const StepService&) = delete;
  StepService& operator=(const StepService&) = delete;

  /// Throws messages::ServiceError for a request that is too short.
  messages::WireBuffer answer(messages::WireView request) const;
  /// The requests that wait for a thread.
  const std::shared_ptr<RequestQueue>& queue() const { return queue_; }
  /// Ends the threads, after their current answers.
  void stop();

 private:
  const Action action_;
  const messages::Layout layout_;
  const std::shared_ptr<RequestQueue> queue_ = std::make_shared<RequestQueue>(nullptr);
  std::atomic<bool> ending_{false};
  std::array<std::thread, 2> threads_;
};

}  // namespace bubblesim
