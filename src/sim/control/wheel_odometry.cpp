// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/control/wheel_odometry.hpp"

#include <cmath>

namespace bubblesim::control {

void WheelOdometry::move(const PlanarMotion& motion, double period) {
  constexpr double kStraight = 1e-6;  // rad
  const double turn = motion.turn;
  // The displacement in the frame before, for a velocity that is constant in the robot's frame.
  const double along = std::abs(turn) < kStraight ? 1 : std::sin(turn) / turn;
  const double across = std::abs(turn) < kStraight ? turn / 2 : (1 - std::cos(turn)) / turn;
  const double x = along * motion.forward - across * motion.left;
  const double y = across * motion.forward + along * motion.left;
  x_ += x * std::cos(heading_) - y * std::sin(heading_);
  y_ += x * std::sin(heading_) + y * std::cos(heading_);
  heading_ += turn;
  if (!(period > 0)) return;
  velocities_.push_back({motion.forward / period, motion.left / period, turn / period});
  if (velocities_.size() > window_) velocities_.pop_front();
  velocity_ = {};
  const auto count = static_cast<double>(velocities_.size());
  for (const PlanarMotion& each : velocities_) {
    velocity_.forward += each.forward / count;
    velocity_.left += each.left / count;
    velocity_.turn += each.turn / count;
  }
}

void WheelOdometry::reset() {
  velocities_.clear();
  velocity_ = {};
  x_ = y_ = heading_ = 0;
}

void WheelOdometry::transfer(StateArchive& archive) {
  archive(x_, y_, heading_, velocity_.forward, velocity_.left, velocity_.turn);
  velocities_.resize(archive.count(velocities_.size()));
  for (PlanarMotion& each : velocities_) archive(each.forward, each.left, each.turn);
}

}  // namespace bubblesim::control
