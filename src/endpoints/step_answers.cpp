// SPDX-License-Identifier: BSD-3-Clause
#include "step_answers.hpp"

#include <limits>
#include <string>

#include "bubblesim/messages/bridge.hpp"

namespace bubblesim {
namespace {

using messages::Layout;
using messages::ServiceError;
using messages::WireBuffer;
using messages::WireView;

constexpr std::uint8_t kOk = 1;  // constants of simulation_interfaces/Result
constexpr std::uint8_t kOperationFailed = 4;

template <class Number>
Number steps_in(WireView request, Layout layout) {
  const std::size_t least = sizeof(Number);
  const bool fits = layout == Layout::kCdr ? request.left() >= least : request.left() == least;
  if (!fits) throw ServiceError("the request must be " + std::to_string(least) + " bytes: the number of steps");
  return request.get<Number>();
}

}  // namespace

WireBuffer answer_step(const StepAction& action, WireView request, Layout layout) {
  const StepAnswer answer = action(steps_in<std::uint32_t>(request, layout));
  WireBuffer response;
  response.begin(layout);
  response.put<std::uint8_t>(answer.problem.empty() ? 1 : 0);
  response.put_string(answer.problem);
  response.put(answer.time);
  return response;
}

WireBuffer answer_step_simulation(const StepAction& action, WireView request, Layout layout) {
  const auto steps = steps_in<std::uint64_t>(request, layout);
  constexpr std::uint32_t kMost = std::numeric_limits<std::uint32_t>::max();
  const std::string problem = steps > kMost ? std::to_string(kMost) + " steps are the most for a request"
                                            : action(static_cast<std::uint32_t>(steps)).problem;
  WireBuffer response;
  response.begin(layout);
  response.put(problem.empty() ? kOk : kOperationFailed);
  response.put_string(problem);
  return response;
}

}  // namespace bubblesim
