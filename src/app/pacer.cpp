// SPDX-License-Identifier: BSD-3-Clause
#include "pacer.hpp"

#include <cmath>
#include <thread>

namespace bubblesim::app {
namespace {

constexpr std::chrono::milliseconds kMostBehind{200};

}  // namespace

void Pacer::wait_for(double simulated) {
  if (std::isinf(speed_)) return;
  const Clock::time_point now = Clock::now();
  const auto restart = [&] {
    started_ = true;
    start_ = now;
    simulated_at_start_ = simulated;
  };
  if (!started_) restart();
  const std::chrono::duration<double> since_start((simulated - simulated_at_start_) / speed_);
  const Clock::time_point due = start_ + std::chrono::duration_cast<Clock::duration>(since_start);
  if (now - due > kMostBehind) {
    restart();
    return;
  }
  std::this_thread::sleep_until(due);
}

}  // namespace bubblesim::app
