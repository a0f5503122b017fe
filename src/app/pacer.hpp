// SPDX-License-Identifier: BSD-3-Clause
// Keeps the simulation's time in step with the clock on the wall.
#pragma once

#include <chrono>

namespace bubblesim::app {

class Pacer {
 public:
  /// `speed`: simulated seconds per second; infinity never waits.
  explicit Pacer(double speed) : speed_(speed) {}

  /// Waits until `simulated` seconds since the first call are due, though never longer than a moment, so that the
  /// caller can look for signals; returns whether they are due. A simulation that fell far behind goes on from where it
  /// is instead of rushing after the time it lost.
  bool wait_for(double simulated);
  /// Counts anew from the next call: after a pause.
  void restart() { started_ = false; }

 private:
  using Clock = std::chrono::steady_clock;

  double speed_;
  bool started_ = false;
  Clock::time_point start_;
  double simulated_at_start_ = 0;
};

}  // namespace bubblesim::app
