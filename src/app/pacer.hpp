// SPDX-License-Identifier: BSD-3-Clause
// Keeps the simulation time in step with wall time.
#pragma once

#include <chrono>

namespace bubblesim::app {

class Pacer {
 public:
  /// `speed`: simulated seconds per second; infinity never waits.
  explicit Pacer(double speed) : speed_(speed) {}

  /// Waits until `simulated` seconds since the first call are due, but only for a short time, so that the caller can
  /// check for signals. Returns whether they are due. A simulation that fell far behind continues at its speed instead
  /// of catching up.
  bool wait_for(double simulated);
  /// Restarts the count at the next call: after a pause.
  void restart() { started_ = false; }

 private:
  using Clock = std::chrono::steady_clock;

  double speed_;
  bool started_ = false;
  Clock::time_point start_;
  double simulated_at_start_ = 0;
};

}  // namespace bubblesim::app
