// SPDX-License-Identifier: BSD-3-Clause
#include "step_service.hpp"

#include <chrono>
#include <utility>

#include "quiet_thread.hpp"

namespace bubblesim {

StepService::StepService(StepAction action, messages::Layout layout) : action_(std::move(action)), layout_(layout) {
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

}  // namespace bubblesim
