// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pthread.h>
#include <signal.h>

#include <thread>
#include <utility>

namespace bubblesim {

/// Starts a thread that blocks all signals, so that SIGINT and SIGTERM reach the thread that waits for them.
template <class Function>
std::thread start_without_signals(Function&& function) {
  sigset_t all;
  sigset_t previous;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &previous);
  std::thread thread(std::forward<Function>(function));
  pthread_sigmask(SIG_SETMASK, &previous, nullptr);
  return thread;
}

}  // namespace bubblesim
