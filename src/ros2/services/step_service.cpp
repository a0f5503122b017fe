// SPDX-License-Identifier: BSD-3-Clause
#include "services/step_service.hpp"

#include <utility>

#include "quiet_thread.hpp"

namespace bubblesim::ros2 {

StepService::StepService(Action action) : action_(std::move(action)) {
  for (std::thread& thread : threads_) {
    thread = start_without_signals([this] {
      const auto is_ending = [this] { return ending_.load(); };
      while (!queue_.serve_until(is_ending, RequestQueue::Clock::now() + std::chrono::hours(1))) continue;
    });
  }
}

StepService::~StepService() { stop(); }

void StepService::stop() {
  ending_ = true;
  queue_.wake();
  for (std::thread& thread : threads_) {
    if (thread.joinable()) thread.join();
  }
}

/// The fields of bubblesim_msgs/Step.
messages::WireBuffer StepService::answer(messages::WireView request) const {
  if (request.left() < sizeof(std::uint32_t)) throw messages::ServiceError("the request must be 4 bytes: uint32 steps");
  const StepAnswer answer = action_(request.get<std::uint32_t>());
  messages::WireBuffer response;
  response.begin(messages::Layout::kCdr);
  response.put<std::uint8_t>(answer.problem.empty() ? 1 : 0);
  response.put_string(answer.problem);
  response.put(answer.time);
  return response;
}

}  // namespace bubblesim::ros2
