// SPDX-License-Identifier: BSD-3-Clause
#include "step_service.hpp"

#include <chrono>
#include <utility>

#include "bubblesim/messages/bridge.hpp"
#include "quiet_thread.hpp"

namespace bubblesim {

StepService::StepService(Action action, messages::Layout layout) : action_(std::move(action)), layout_(layout) {
  for (std::thread& thread : threads_) {
    thread = start_without_signals([this] {
      const auto is_ending = [this] { return ending_.load(); };
      while (!queue_->serve_until(is_ending, RequestQueue::Clock::now() + std::chrono::hours(1))) continue;
    });
  }
}

void StepService::stop() {
  ending_ = true;
  queue_->wake();
  for (std::thread& thread : threads_) {
    if (thread.joinable()) thread.join();
  }
}

/// The fields of bubblesim_msgs/Step.
messages::WireBuffer StepService::answer(messages::WireView request) const {
  if (request.left() < sizeof(std::uint32_t)) throw messages::ServiceError("the request must be 4 bytes: uint32 steps");
  const StepAnswer answer = action_(request.get<std::uint32_t>());
  messages::WireBuffer response;
  response.begin(layout_);
  response.put<std::uint8_t>(answer.problem.empty() ? 1 : 0);
  response.put_string(answer.problem);
  response.put(answer.time);
  return response;
}

}  // namespace bubblesim
