// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>

#include "bubblesim/messages/wire.hpp"
#include "bubblesim/node_bridge.hpp"

namespace bubblesim {

using StepAction = std::function<StepAnswer(std::uint32_t steps)>;

/// A service whose answer waits for the steps of its request.
struct SteppingService {
  const char* name;
  const char* type;
  messages::WireBuffer (*answer)(const StepAction& action, messages::WireView request, messages::Layout layout);
};

/// bubblesim_msgs/Step: uint32 steps; bool success, string status_message, float64 time. Throws ServiceError for a
/// request that is too short.
messages::WireBuffer answer_step(const StepAction& action, messages::WireView request, messages::Layout layout);

/// simulation_interfaces/StepSimulation: uint64 steps; uint8 result, string error_message. Throws ServiceError.
messages::WireBuffer answer_step_simulation(const StepAction& action, messages::WireView request,
                                            messages::Layout layout);

constexpr SteppingService kSteppingServices[] = {
    {"~step", "bubblesim_msgs/Step", &answer_step},
    {"/step_simulation", "simulation_interfaces/StepSimulation", &answer_step_simulation},
};

}  // namespace bubblesim
