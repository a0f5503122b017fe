// SPDX-License-Identifier: BSD-3-Clause
#include "services/step_service.hpp"

#include <utility>

#include "quiet_thread.hpp"

namespace bubblesim {
namespace {

const ros::WallDuration kBetweenChecks(0.1);

}  // namespace

StepService::StepService(StepAction action) : action_(std::move(action)) {
  for (std::thread& thread : threads_) {
    thread = start_without_signals([this] {
      while (!ending_) queue_.callOne(kBetweenChecks);
    });
  }
}

void StepService::stop() {
  ending_ = true;
  for (std::thread& thread : threads_) {
    if (thread.joinable()) thread.join();
  }
}

messages::WireBuffer StepService::answer(const SteppingService& service, messages::WireView request) const {
  return service.answer(action_, request, messages::Layout::kPacked);
}

}  // namespace bubblesim
