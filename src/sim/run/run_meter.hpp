// SPDX-License-Identifier: BSD-3-Clause
// Measures the steps of a runner.
#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

#include "bubblesim/run_report.hpp"
#include "bubblesim/run_state.hpp"
#include "bubblesim/simulation.hpp"

namespace bubblesim {

/// The runner's thread measures; other threads may take the reports.
class RunMeter {
 public:
  explicit RunMeter(double wanted_speed) { report_.wanted_speed = wanted_speed; }

  /// Runs and measures one step.
  void run_step(Simulation& simulation);
  /// Call it in each round of the loop, whether the round runs a step or not.
  void note(const Simulation& simulation, RunState state, bool running);
  /// Records that the simulation failed for good.
  void fail(const std::string& why);

  void set_wanted_speed(double speed) {
    const std::lock_guard lock(mutex_);
    report_.wanted_speed = speed;
  }

  /// Returns the report since the last call, without what is known of scripts. Thread-safe.
  RunReport take();
  /// Returns the totals in one line: simulated seconds, real-time factor, steps. Thread-safe.
  std::string summary();

 private:
  using Clock = std::chrono::steady_clock;

  std::mutex mutex_;
  RunReport report_;
  double simulated_time_ = 0;  // s, of all steps
  double wall_time_ = 0;       // s, of all steps
  std::uint64_t steps_ = 0;
  std::optional<Clock::time_point> last_end_;  // of a step; empty: the time until the next step is not counted
};

}  // namespace bubblesim
