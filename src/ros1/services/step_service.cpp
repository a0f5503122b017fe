// SPDX-License-Identifier: BSD-3-Clause
#include "services/step_service.hpp"

#include <utility>

#include "bubblesim/messages/bridge.hpp"
#include "quiet_thread.hpp"

namespace bubblesim {
namespace {

const ros::WallDuration kBetweenChecks(0.1);

}  // namespace

StepService::StepService(Action action) : action_(std::move(action)) {
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

/// The fields of bubblesim_msgs/Step.
messages::WireBuffer StepService::answer(messages::WireView request) const {
  if (request.left() != sizeof(std::uint32_t))
    throw messages::ServiceError("the request must be 4 bytes: uint32 steps");
  const StepAnswer answer = action_(request.get<std::uint32_t>());
  messages::WireBuffer response;
  response.put<std::uint8_t>(answer.problem.empty() ? 1 : 0);
  response.put(static_cast<std::uint32_t>(answer.problem.size()));
  response.put_bytes(answer.problem.data(), answer.problem.size());
  response.put(answer.time);
  return response;
}

}  // namespace bubblesim
