// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/planar_drive.hpp"

#include <cmath>

#include "devices/planar_limits.hpp"

namespace bubblesim {

void PlanarDrive::set_velocity(double forward, double leftward, double turning) {
  check_planar_velocity(forward, leftward, turning);
  forward_ = forward;
  leftward_ = leftward;
  turning_ = turning;
  commanded_ = true;
}

void PlanarDrive::update(World& world, double, double duration) {
  if (!commanded_) return;
  // The heading in the middle of the time until the next update makes the path the commanded arc.
  const double yaw = to_rpy(world.pose(model_).orientation).z() + turning_ * duration / 2;
  const double along = std::cos(yaw);
  const double across = std::sin(yaw);
  world.set_planar_velocity(model_, along * forward_ - across * leftward_, across * forward_ + along * leftward_,
                            turning_);
}

void PlanarDrive::reset(World&) {
  forward_ = leftward_ = turning_ = 0;
  commanded_ = false;
}

void PlanarDrive::transfer(StateArchive& archive) { archive(forward_, leftward_, turning_, commanded_); }

}  // namespace bubblesim
