// SPDX-License-Identifier: BSD-3-Clause
#include "stop_signal.hpp"

#include <csignal>
#include <initializer_list>

namespace bubblesim::app {
namespace {

volatile std::sig_atomic_t requested = 0;

void request(int signal) {
  if (requested != 0) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
  requested = 1;
}

}  // namespace

void watch_stop_signals() {
  struct sigaction action {};
  action.sa_handler = request;
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM}) sigaction(signal, &action, nullptr);
}

bool stop_requested() { return requested != 0; }

}  // namespace bubblesim::app
