// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <mutex>
#include <utility>

namespace bubblesim {

/// Notifies the simulation thread that input has arrived. Thread-safe.
class Arrivals {
 public:
  explicit Arrivals(std::function<void()> on_arrival) : on_arrival_(std::move(on_arrival)) {}

  void note() {
    const std::lock_guard lock(mutex_);
    if (on_arrival_) on_arrival_();
  }
  /// From here on, note() does nothing: the middleware's threads may outlive the simulation.
  void silence() {
    const std::lock_guard lock(mutex_);
    on_arrival_ = nullptr;
  }

 private:
  std::mutex mutex_;
  std::function<void()> on_arrival_;
};

}  // namespace bubblesim
