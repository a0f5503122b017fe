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

/// Measures how the steps of a simulation go; another thread may take the reports.
class RunMeter {
 public:
  RunMeter(const Simulation& simulation, double wanted_speed);

  /// One step.
  void run_step(Simulation& simulation);
  /// To be called in each round of the loop that runs the steps, whether it runs one or not.
  void note(const Simulation& simulation, const ChildScripts& scripts);
  /// The simulation has ended for good.
  void fail(const std::string& why);

  /// What has happened since the last call. Any thread may call it.
  RunReport take();
  /// What was simulated so far, in one line: seconds, real-time factor, steps.
  std::string summary();

 private:
  using Clock = std::chrono::steady_clock;

  std::mutex mutex_;
  RunReport report_;
  double simulated_time_ = 0;  // s, of all steps
  double wall_time_ = 0;       // s, that they took
  std::uint64_t steps_ = 0;
  std::optional<Clock::time_point> last_end_;  // of a step; none: the time until the next one does not count
};

}  // namespace bubblesim::app
