// SPDX-License-Identifier: BSD-3-Clause
#include "run/run_meter.hpp"

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <utility>

namespace bubblesim {
namespace {

double seconds(std::chrono::steady_clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

}  // namespace

void RunMeter::run_step(Simulation& simulation) {
  const Clock::time_point begin = Clock::now();
  simulation.step();
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

void RunMeter::note(const Simulation& simulation, RunState state, bool running) {
  const std::lock_guard lock(mutex_);
  report_.state = name(state);
  report_.running = running;
  report_.simulation_time = simulation.time();
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

}  // namespace bubblesim
