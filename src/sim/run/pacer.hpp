// SPDX-License-Identifier: BSD-3-Clause
// Keeps the simulation time in step with wall time.
#pragma once

#include <chrono>

namespace bubblesim {

class Pacer {
 public:
  using Clock = std::chrono::steady_clock;

  /// `speed`: simulated seconds per second; infinity never waits.
  explicit Pacer(double speed) : speed_(speed) {}

  /// When `simulated` seconds since the first call are due, at `now`. A simulation that fell far behind continues at
  /// its speed instead of catching up.
  Clock::time_point due(double simulated, Clock::time_point now);
  /// Restarts the count at the next call: after a pause.
  void restart() { started_ = false; }
  double speed() const { return speed_; }
  /// From now on.
  void set_speed(double speed) {
    speed_ = speed;
    restart();
  }

 private:
  double speed_;
  bool started_ = false;
  Clock::time_point start_;
  double simulated_at_start_ = 0;
};

}  // namespace bubblesim
