// SPDX-License-Identifier: BSD-3-Clause
// The pose of a robot from the motion of its wheels.
#pragma once

#include <cstddef>
#include <deque>

#include "bubblesim/state_archive.hpp"

namespace bubblesim::control {

/// A motion in the robot's frame.
struct PlanarMotion {
  double forward = 0;  ///< m
  double left = 0;     ///< m
  double turn = 0;     ///< rad
};

/// Integrates motions with constant velocities, that is, along arcs, and averages velocities over the last updates.
class WheelOdometry {
 public:
  /// `window`: number of updates whose velocities are averaged, at least 1.
  explicit WheelOdometry(std::size_t window) : window_(window > 0 ? window : 1) {}

  /// `period`: s that the motion took.
  void move(const PlanarMotion& motion, double period);
  void reset();
  double x() const { return x_; }              ///< m
  double y() const { return y_; }              ///< m
  double heading() const { return heading_; }  ///< rad, with full turns
  /// Mean velocities, m/s and rad/s.
  const PlanarMotion& velocity() const { return velocity_; }
  void transfer(StateArchive& archive);

 private:
  std::size_t window_;
  std::deque<PlanarMotion> velocities_;
  PlanarMotion velocity_;
  double x_ = 0;
  double y_ = 0;
  double heading_ = 0;
};

}  // namespace bubblesim::control
