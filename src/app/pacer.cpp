// SPDX-License-Identifier: BSD-3-Clause
#include "pacer.hpp"

#include <cmath>
#include <thread>

namespace bubblesim::app {
namespace {

constexpr std::chrono::duration<double> kMostBehind{0.2};
constexpr std::chrono::duration<double> kLongestWait{0.05};

}  // namespace

bool Pacer::wait_for(double simulated) {
  if (std::isinf(speed_)) return true;
  const Clock::time_point now = Clock::now();
  const auto restart = [&] {
    started_ = true;
    start_ = now;
    simulated_at_start_ = simulated;
  };
  if (!started_) restart();
  const std::chrono::duration<double> due((simulated - simulated_at_start_) / speed_);
  const std::chrono::duration<double> left = due - (now - start_);
  if (-left > kMostBehind) restart();
  if (left > kLongestWait) {
    std::this_thread::sleep_for(kLongestWait);
    return false;
  }
  // Wait until a point in time: the sum of many waits for a duration drifts.
  std::this_thread::sleep_until(start_ + std::chrono::duration_cast<Clock::duration>(due));
  return true;
}

}  // namespace bubblesim::app
