// SPDX-License-Identifier: BSD-3-Clause
#include "stop_signal.hpp"

#include <pthread.h>
#include <semaphore.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <initializer_list>
#include <utility>

#include "child_processes.hpp"

namespace bubblesim::app {
namespace {

constexpr std::chrono::milliseconds kBetweenInterrupts{250};
constexpr int kInterrupts = 4;  // before the process is killed

volatile std::sig_atomic_t requested = 0;
volatile std::sig_atomic_t last_signal = SIGTERM;
std::atomic<void (*)()> interrupt_now{nullptr};
static_assert(std::atomic<void (*)()>::is_always_lock_free);
sem_t signalled;

void request(int signal) {
  requested = 1;
  if (const auto interrupt = interrupt_now.load()) {  // the signal came from this guard
    interrupt();
    return;
  }
  last_signal = signal;
  sem_post(&signalled);
}

}  // namespace

void watch_stop_signals() {
  sem_init(&signalled, 0, 0);
  struct sigaction action {};
  action.sa_handler = request;
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM}) sigaction(signal, &action, nullptr);
  struct sigaction at_hang_up {};
  sigaction(SIGHUP, nullptr, &at_hang_up);
  if (at_hang_up.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);  // ignored under nohup
}

void request_stop() { kill(getpid(), SIGTERM); }

bool stop_requested() { return requested != 0; }

StopGuard::StopGuard(void (*interrupt)(), std::function<void()> leave)
    : interrupt_(interrupt), leave_(std::move(leave)), guarded_(pthread_self()) {
  sigset_t all;
  sigset_t previous;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &previous);  // the guarded thread handles the signals, which wake it
  thread_ = std::thread([this] { watch(); });
  pthread_sigmask(SIG_SETMASK, &previous, nullptr);
}

StopGuard::~StopGuard() {
  {
    const std::lock_guard lock(mutex_);
    done_ = true;
  }
  changed_.notify_all();
  sem_post(&signalled);
  thread_.join();
}

bool StopGuard::done_within(std::chrono::milliseconds time) {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, time, [this] { return done_; });
}

void StopGuard::watch() {
  while (!stop_requested()) {
    sem_wait(&signalled);
    if (done_within(std::chrono::milliseconds(0))) return;
  }
  for (int i = 0; i < kInterrupts; ++i) {
    if (done_within(kBetweenInterrupts)) return;
    interrupt_now = interrupt_;
    pthread_kill(guarded_, SIGINT);  // wakes it from a system call, such as a sleep
  }
  if (done_within(kBetweenInterrupts)) return;
  std::fputs("error: a script does not return; ending the simulator\n", stderr);
  signal_child_processes(SIGTERM);
  leave_();
  done_within(kBetweenInterrupts);
  signal_child_processes(SIGKILL);
  const int signal = last_signal;
  std::signal(signal, SIG_DFL);
  kill(getpid(), signal);
  // All other threads may block the signal, so this one handles it.
  sigset_t one;
  sigemptyset(&one);
  sigaddset(&one, signal);
  pthread_sigmask(SIG_UNBLOCK, &one, nullptr);
}

}  // namespace bubblesim::app
