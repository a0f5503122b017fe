// SPDX-License-Identifier: BSD-3-Clause
// A vector that a sensor measures in each substep.
#pragma once

#include <cmath>

#include "bubblesim/math.hpp"
#include "bubblesim/state_archive.hpp"

namespace bubblesim {

class SubstepSignal {
 public:
  /// `bandwidth` in Hz: the -3 dB frequency of a first-order low-pass filter; 0 for the mean since clear().
  explicit SubstepSignal(double bandwidth) : bandwidth_(bandwidth) {}

  /// Call at the start of a simulation step. The filter continues.
  void clear() {
    sum_ = Vector3::Zero();
    time_ = 0;
  }
  void add(const Vector3& value, double step) {
    sum_ += value * step;
    time_ += step;
    if (bandwidth_ <= 0) return;
    filtered_ = started_ ? filtered_ + (value - filtered_) * (1 - std::exp(-2 * M_PI * bandwidth_ * step)) : value;
    started_ = true;
  }
  /// Zero before the first value.
  Vector3 value() const {
    if (bandwidth_ > 0) return filtered_;
    if (time_ > 0) return sum_ / time_;
    return {};
  }
  void transfer(StateArchive& archive) { archive(sum_, time_, filtered_, started_); }
  bool has_value() const { return bandwidth_ > 0 ? started_ : time_ > 0; }

 private:
  double bandwidth_;
  Vector3 sum_;
  double time_ = 0;  // s
  Vector3 filtered_;
  bool started_ = false;
};

}  // namespace bubblesim
