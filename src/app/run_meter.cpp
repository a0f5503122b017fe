// SPDX-License-Identifier: BSD-3-Clause
#include "run_meter.hpp"

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <utility>

namespace bubblesim::app {
namespace {

double seconds(std::chrono::steady_clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

const char* name(RunState state) {
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

}  // namespace

RunMeter::RunMeter(const Simulation& simulation, double wanted_speed) {
  report_.wanted_speed = wanted_speed;
  report_.state = name(simulation.state());
}

void RunMeter::run_step(Simulation& simulation) {
  const Clock::time_point begin = Clock::now();
  simulation.run_step();
  const Clock::time_point end = Clock::now();
  const std::lock_guard lock(mutex_);
  ++report_.steps;
  report_.simulated_time += simulation.time_step();
  report_.wall_time += seconds(end - last_end_.value_or(begin));
  report_.step_time += seconds(end - begin);
  report_.longest_step = std::max(report_.longest_step, seconds(end - begin));
  ++steps_;
  simulated_time_ += simulation.time_step();
  wall_time_ += seconds(end - last_end_.value_or(begin));
  last_end_ = end;
}

void RunMeter::note(const Simulation& simulation, const ChildScripts& scripts) {
  const std::lock_guard lock(mutex_);
  report_.state = name(simulation.state());
  report_.running = simulation.state() == RunState::kRunning && simulation.step_is_due();
  report_.simulation_time = simulation.time();
  report_.disabled_scripts = scripts.disabled();
  report_.script_errors = scripts.failures();
  report_.measurements = simulation.measurements();
  if (!report_.running) {
    last_end_.reset();
  } else {
    report_.failure.clear();
  }
  if (report_.running && !last_end_) {
    last_end_ = Clock::now();
  }
}

void RunMeter::fail(const std::string& why) {
  const std::lock_guard lock(mutex_);
  report_.running = false;
  report_.state = "ended";
  report_.failure = why;
}

RunReport RunMeter::take() {
  const std::lock_guard lock(mutex_);
  RunReport report = report_;
  report.since_last_step = report_.running && last_end_ ? seconds(Clock::now() - *last_end_) : 0;
  report_.steps = 0;
  report_.simulated_time = report_.wall_time = report_.step_time = report_.longest_step = 0;
  return report;
}

std::string RunMeter::summary() {
  const std::lock_guard lock(mutex_);
  std::ostringstream text;
  text << std::fixed << std::setprecision(2) << "simulated " << simulated_time_ << " s in " << wall_time_
       << " s: real-time factor " << (wall_time_ > 0 ? simulated_time_ / wall_time_ : 0.0) << ", " << steps_
       << " steps";
  return text.str();
}

}  // namespace bubblesim::app
