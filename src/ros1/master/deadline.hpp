// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>

namespace bubblesim {

/// Time limit of a job on its own thread: a point in time, or until the waiting thread gives up.
class Deadline {
 public:
  using Clock = std::chrono::steady_clock;

  explicit Deadline(Clock::time_point end) : end_(end) {}

  Clock::time_point end() const { return end_; }
  void give_up() { *given_up_ = true; }  ///< also for all copies
  bool over() const { return *given_up_ || Clock::now() >= end_; }
  /// How long to wait before checking over() again.
  std::chrono::milliseconds slice() const {
    constexpr std::chrono::milliseconds kSlice{50};
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(end_ - Clock::now());
    return std::clamp(left, std::chrono::milliseconds(0), kSlice);
  }

 private:
  Clock::time_point end_;
  std::shared_ptr<std::atomic<bool>> given_up_ = std::make_shared<std::atomic<bool>>(false);
};

}  // namespace bubblesim
