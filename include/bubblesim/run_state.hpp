// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace bubblesim {

enum class RunState { kStopped, kPaused, kRunning, kStopping };  // stopping: in the last step

/// One word, such as "running".
std::string_view name(RunState state);

}  // namespace bubblesim
