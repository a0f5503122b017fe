// SPDX-License-Identifier: BSD-3-Clause
// The pose of a robot from the motion of its wheels.
#pragma once

#include <cstddef>
#include <deque>

#include "bubblesim/state_archive.hpp"

namespace bubblesim::control {

/// Integrates motions along arcs, and averages velocities over the last updates.
class WheelOdometry {
 public:
  /// `window`: number of updates whose velocities are averaged, at least 1.
  explicit WheelOdometry(std::size_t window) : window_(window > 0 ? window : 1) {}

  /// Moves by `distance` in m while turning by `angle` in rad, which took `period` s.
  void move(double distance, double angle, double period);
  void reset();
  double x() const { return x_; }              ///< m
  double y() const { return y_; }              ///< m
  double heading() const { return heading_; }  ///< rad, with full turns
  double linear() const { return linear_; }    ///< m/s, mean
  double angular() const { return angular_; }  ///< rad/s, mean
  void transfer(StateArchive& archive);

 private:
  std::size_t window_;
  std::deque<std::pair<double, double>> velocities_;
  double x_ = 0;
  double y_ = 0;
  double heading_ = 0;
  double linear_ = 0;
  double angular_ = 0;
};

}  // namespace bubblesim::control
