// SPDX-License-Identifier: BSD-3-Clause
#include "run/pacer.hpp"

#include <cmath>

namespace bubblesim {
namespace {

constexpr std::chrono::duration<double> kMostBehind{0.2};

}  // namespace

Pacer::Clock::time_point Pacer::due(double simulated, Clock::time_point now) {
  if (std::isinf(speed_)) return now;
  if (!started_) {
    started_ = true;
    start_ = now;
    simulated_at_start_ = simulated;
  }
  // A point in time: the sum of many waits for a duration drifts.
  const std::chrono::duration<double> since_start((simulated - simulated_at_start_) / speed_);
  const Clock::time_point due = start_ + std::chrono::duration_cast<Clock::duration>(since_start);
  if (now - due > kMostBehind) {
    start_ = now;
    simulated_at_start_ = simulated;
  }
  return due;
}

}  // namespace bubblesim
