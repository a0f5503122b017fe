// SPDX-License-Identifier: BSD-3-Clause
// How a simulation is started, paused and stopped by those who do not run its passes.
#include <utility>

#include "bubblesim/simulation.hpp"

namespace bubblesim {

void Simulation::start() { request(Request::kStart); }

void Simulation::pause() { request(Request::kPause); }

void Simulation::stop() { request(Request::kStop); }

void Simulation::request(Request wanted) {
  const std::lock_guard lock(requests_mutex_);
  requests_.push_back(wanted);
}

bool Simulation::has_requests() const {
  const std::lock_guard lock(requests_mutex_);
  return !requests_.empty();
}

void Simulation::carry_out_requests() {
  std::vector<Request> requests;
  {
    const std::lock_guard lock(requests_mutex_);
    requests.swap(requests_);
  }
  // Not those that come meanwhile: scripts that start what was stopped, and stop it again, must not keep this busy.
  for (const Request wanted : requests) carry_out(wanted);
}

void Simulation::carry_out(Request wanted) {
  if (ending_) return;
  const RunState before = state_;
  switch (wanted) {
    case Request::kStart:
      state_ = RunState::kRunning;
      if (before == RunState::kStopped) {
        for (Participant* participant : participants_) participant->start();
      }
      return;
    case Request::kPause:
      if (before == RunState::kRunning) state_ = RunState::kPaused;
      return;
    case Request::kStop:
      if (before == RunState::kStopped) return;
      state_ = RunState::kStopping;
      step();  // scripts see that it is the last one
      if (ends_at_stop_) return end();
      for (Participant* participant : participants_) participant->stop();
      reset();
      state_ = RunState::kStopped;
      return;
  }
}

}  // namespace bubblesim
