// SPDX-License-Identifier: BSD-3-Clause
#include "services/step_service.hpp"

#include <utility>

#include "quiet_thread.hpp"

namespace bubblesim::ros2 {

StepService::StepService(StepAction action) : action_(std::move(action)) {
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

messages::WireBuffer StepService::answer(const SteppingService& service, messages::WireView request) const {
  return service.answer(action_, request, messages::Layout::kCdr);
}

}  // namespace bubblesim::ros2
