// SPDX-License-Identifier: BSD-3-Clause
// Handles SIGINT, SIGTERM and SIGHUP: a flag that the main loop reads, and a guard for when a script blocks the loop.
#pragma once

#include <pthread.h>

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace bubblesim::app {

/// Makes SIGINT, SIGTERM and SIGHUP set stop_requested(); SIGHUP unless it is ignored, as under nohup.
void watch_stop_signals();
bool stop_requested();
/// Does the same as SIGTERM. Thread-safe.
void request_stop();

/// Ensures that the thread that made it reaches the guard's destructor about a second after a signal. Until then, a
/// signal handler on that thread calls `interrupt` four times a second, which also ends a sleep. Finally a thread of
/// the guard calls `leave`, ends the child processes, and kills the process with the signal.
class StopGuard {
 public:
  StopGuard(void (*interrupt)(), std::function<void()> leave);
  ~StopGuard();
  StopGuard(const StopGuard&) = delete;
  StopGuard& operator=(const StopGuard&) = delete;

 private:
  bool done_within(std::chrono::milliseconds time);
  void watch();

  void (*const interrupt_)();
  const std::function<void()> leave_;
  const pthread_t guarded_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool done_ = false;
  std::thread thread_;
};

}  // namespace bubblesim::app
