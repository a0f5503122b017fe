// SPDX-License-Identifier: BSD-3-Clause
#include "joint.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace bubblesim {
namespace {

/// How fast position control closes the gap to its target, as a time constant in seconds: one default pass.
constexpr double kServoTime = 0.05;

/// The turn from `from` to `to` that is at most half a revolution.
double shortest_turn(double from, double to) { return std::remainder(to - from, 2 * M_PI); }

}  // namespace

Joint::Joint(std::vector<AxisDescription> axes) {
  for (AxisDescription& description : axes) {
    if (description.motor == MotorMode::kPosition) position_controlled_.push_back(static_cast<int>(axes_.size()));
    axes_.push_back({std::move(description), 0, 0});
  }
}

void Joint::apply_axes() {
  for (int i = 0; i < axis_count(); ++i) {
    const AxisDescription& description = axis(i);
    // ODE wants the upper stop set first when the lower one lies above the default upper one.
    if (std::isfinite(description.upper)) set_parameter(i, dParamHiStop, description.upper);
    if (std::isfinite(description.lower)) set_parameter(i, dParamLoStop, description.lower);
    if (std::isfinite(description.upper)) set_parameter(i, dParamHiStop, description.upper);
    apply_motor(i);
  }
}

void Joint::apply_motor(int index) {
  const Axis& axis = axes_[static_cast<std::size_t>(index)];
  const AxisDescription& description = axis.description;
  if (description.motor == MotorMode::kNone) {
    // A motor at rest that may slip: limited by the friction, softened by 1/damping (implicit, so stable for any
    // value).
    const bool damped = description.damping > 0;
    set_parameter(index, dParamVel, 0);
    set_parameter(index, dParamFMax, damped ? dInfinity : description.friction);
    if (damped) set_parameter(index, dParamCFM, 1 / description.damping);
    return;
  }
  set_parameter(index, dParamFMax, std::isfinite(description.max_force) ? description.max_force : dInfinity);
  if (description.motor == MotorMode::kVelocity) {
    set_parameter(index, dParamVel,
                  std::clamp(axis.target_velocity, -description.max_velocity, description.max_velocity));
  }
}

void Joint::set_target_position(int axis, double position) {
  axes_[static_cast<std::size_t>(axis)].target_position = position;
}

void Joint::set_target_velocity(int axis, double velocity) {
  axes_[static_cast<std::size_t>(axis)].target_velocity = velocity;
  apply_motor(axis);
}

void Joint::set_max_force(int axis, double force) {
  axes_[static_cast<std::size_t>(axis)].description.max_force = force;
  apply_motor(axis);
}

void Joint::drive(double step) {
  for (const int index : position_controlled_) {
    const Axis& axis = axes_[static_cast<std::size_t>(index)];
    const AxisDescription& description = axis.description;
    const bool endless = !std::isfinite(description.lower) && !std::isfinite(description.upper);
    const double here = position(index);
    const double gap = endless ? shortest_turn(here, axis.target_position)
                               : std::clamp(axis.target_position, description.lower, description.upper) - here;
    set_parameter(index, dParamVel,
                  std::clamp(gap / std::max(kServoTime, step), -description.max_velocity, description.max_velocity));
  }
}

}  // namespace bubblesim
