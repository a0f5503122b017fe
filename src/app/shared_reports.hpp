// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <mutex>
#include <utility>
#include <vector>

#include "bubblesim/run_report.hpp"

namespace bubblesim::app {

/// The reports of a run for several readers: each gets what happened since its own last one. Thread-safe.
class SharedReports {
 public:
  SharedReports(std::function<RunReport()> take, std::size_t readers) : take_(std::move(take)), waiting_(readers) {}

  RunReport take(std::size_t reader) {
    const std::lock_guard lock(mutex_);
    const RunReport latest = take_();
    for (RunReport& report : waiting_) report = joined(report, latest);
    return std::exchange(waiting_[reader], {});
  }

 private:
  static RunReport joined(const RunReport& earlier, RunReport later) {
    later.steps += earlier.steps;
    later.simulated_time += earlier.simulated_time;
    later.wall_time += earlier.wall_time;
    later.step_time += earlier.step_time;
    later.longest_step = std::max(later.longest_step, earlier.longest_step);
    return later;
  }

  const std::function<RunReport()> take_;
  std::mutex mutex_;
  std::vector<RunReport> waiting_;
};

}  // namespace bubblesim::app
