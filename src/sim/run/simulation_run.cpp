// SPDX-License-Identifier: BSD-3-Clause
// Start, pause and stop requests from other threads than the one that runs the steps.
#include <algorithm>
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

void Simulation::set_synchronous(bool synchronous) {
  const std::lock_guard lock(requests_mutex_);
  synchronous_ = synchronous;
  if (!synchronous) triggers_ = 0;
}

void Simulation::trigger_step() {
  const std::lock_guard lock(requests_mutex_);
  if (synchronous_) ++triggers_;
}

bool Simulation::step_is_due() const {
  if (state_ != RunState::kRunning) return false;
  const std::lock_guard lock(requests_mutex_);
  return !synchronous_ || triggers_ > 0;
}

void Simulation::run_step() {
  {
    const std::lock_guard lock(requests_mutex_);
    if (triggers_ > 0) --triggers_;
  }
  step();
}

bool Simulation::has_requests() const {
  const std::lock_guard lock(requests_mutex_);
  return !requests_.empty();
}

bool Simulation::stop_is_due() const {
  const std::lock_guard lock(requests_mutex_);
  return state_ == RunState::kStopping || std::count(requests_.begin(), requests_.end(), Request::kStop) > 0;
}

void Simulation::forget_triggers() {
  const std::lock_guard lock(requests_mutex_);
  triggers_ = 0;
}

void Simulation::carry_out_requests() {
  std::vector<Request> requests;
  {
    const std::lock_guard lock(requests_mutex_);
    requests.swap(requests_);
  }
  // Only the requests made so far: scripts that keep starting and stopping the simulation must not keep this loop busy.
  for (const Request wanted : requests) carry_out(wanted);
}

void Simulation::carry_out(Request wanted) {
  if (ending_) return;
  const RunState before = state_;
  switch (wanted) {
    case Request::kStart:
      state_ = RunState::kRunning;
      if (before == RunState::kStopped) {
        for (System* system : systems_) system->start();
      }
      return;
    case Request::kPause:
      if (before == RunState::kRunning) state_ = RunState::kPaused;
      return;
    case Request::kStop:
      if (before == RunState::kStopped) return;
      state_ = RunState::kStopping;
      try {
        step();  // scripts see that it is the last step
      } catch (const Diverged&) {
        // The divergence paused it; it is reset now.
      }
      if (ends_at_stop_) return end();
      for (System* system : systems_) system->stop();
      reset();
      state_ = RunState::kStopped;
      forget_triggers();
      return;
  }
}

}  // namespace bubblesim
