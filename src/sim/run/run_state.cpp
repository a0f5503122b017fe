// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/run_state.hpp"

namespace bubblesim {

std::string_view name(RunState state) {
  switch (state) {
    case RunState::kStopped:
      return "stopped";
    case RunState::kPaused:
      return "paused";
    case RunState::kRunning:
      return "running";
    case RunState::kStopping:
      return "stopping";
  }
  return "unknown";
}

}  // namespace bubblesim
