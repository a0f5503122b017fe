// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/control/wheel_odometry.hpp"

#include <cmath>

namespace bubblesim::control {

void WheelOdometry::move(double distance, double angle, double period) {
  constexpr double kStraight = 1e-6;  // rad
  const double before = heading_;
  heading_ += angle;
  if (std::abs(angle) < kStraight) {
    x_ += distance * std::cos(before + angle / 2);
    y_ += distance * std::sin(before + angle / 2);
  } else {
    const double radius = distance / angle;
    x_ += radius * (std::sin(heading_) - std::sin(before));
    y_ -= radius * (std::cos(heading_) - std::cos(before));
  }
  if (!(period > 0)) return;
  velocities_.emplace_back(distance / period, angle / period);
  if (velocities_.size() > window_) velocities_.pop_front();
  linear_ = angular_ = 0;
  for (const auto& [linear, angular] : velocities_) {
    linear_ += linear / static_cast<double>(velocities_.size());
    angular_ += angular / static_cast<double>(velocities_.size());
  }
}

void WheelOdometry::reset() {
  velocities_.clear();
  x_ = y_ = heading_ = linear_ = angular_ = 0;
}

void WheelOdometry::transfer(StateArchive& archive) {
  archive(x_, y_, heading_, linear_, angular_);
  velocities_.resize(archive.count(velocities_.size()));
  for (auto& [linear, angular] : velocities_) archive(linear, angular);
}

}  // namespace bubblesim::control
