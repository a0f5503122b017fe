// SPDX-License-Identifier: BSD-3-Clause
// SIGINT, SIGTERM and SIGHUP as a flag that the main loop reads, and what happens when a script keeps the loop from
// reading it.
#pragma once

#include <pthread.h>

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace bubblesim::app {

/// From now on SIGINT, SIGTERM and SIGHUP set stop_requested(); SIGHUP unless it is ignored, as nohup has it.
void watch_stop_signals();
bool stop_requested();
/// What SIGTERM does. Any thread may call it.
void request_stop();

/// Sees to it that the thread that made it comes to the guard's end about a second after a signal. While it does not,
/// `interrupt` is called four times a second, by a signal handler on that thread, which also ends a sleep; at last
/// `leave` is, on a thread of the guard, the programs that were started are ended, and the process dies of the signal.
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
