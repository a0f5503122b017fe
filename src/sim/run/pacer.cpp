// SPDX-License-Identifier: BSD-3-Clause
#include "run/pacer.hpp"

#include <algorithm>
#include <cmath>

namespace bubblesim {
namespace {

using Seconds = std::chrono::duration<double>;

constexpr Seconds kMostBehind{0.2};
constexpr Seconds kMostAhead{1e9};  // 30 years: a very slow step would be due after the end of the clock

}  // namespace

Pacer::Clock::time_point Pacer::due(double simulated, Clock::time_point now) {
  if (std::isinf(speed_)) return now;
  if (!started_) {
    started_ = true;
    start_ = now;
    simulated_at_start_ = simulated;
  }
  // A point in time: the sum of many waits for a duration drifts.
  const Seconds since_start = std::min(Seconds((simulated - simulated_at_start_) / speed_), kMostAhead);
  const Clock::time_point due = start_ + std::chrono::duration_cast<Clock::duration>(since_start);
  if (now - due > kMostBehind) {
    start_ = now;
    simulated_at_start_ = simulated;
  }
  return due;
}

}  // namespace bubblesim
