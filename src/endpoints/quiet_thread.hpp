// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <thread>
#include <utility>

#include "bubblesim/signals_blocked.hpp"

namespace bubblesim {

/// Starts a thread that blocks all signals, so that SIGINT and SIGTERM reach the thread that waits for them.
template <class Function>
std::thread start_without_signals(Function&& function) {
  const SignalsBlocked blocked;
  return std::thread(std::forward<Function>(function));
}

}  // namespace bubblesim
