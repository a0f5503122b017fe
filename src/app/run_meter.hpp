// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

#include "bubblesim/child_scripts.hpp"
#include "bubblesim/run_report.hpp"
#include "bubblesim/simulation.hpp"

namespace bubblesim::app {

/// Measures the steps of a simulation; another thread may take the reports.
class RunMeter {
 public:
  RunMeter(const Simulation& simulation, double wanted_speed);

  /// Runs and measures one step.
  void run_step(Simulation& simulation);
  /// Call it in each round of the main loop, whether the round runs a step or not.
  void note(const Simulation& simulation, const ChildScripts& scripts);
  /// Records that the simulation failed for good.
  void fail(const std::string& why);

  /// Returns the report since the last call. Thread-safe.
  RunReport take();
  /// Returns the totals in one line: simulated seconds, real-time factor, steps.
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

}  // namespace bubblesim::app
