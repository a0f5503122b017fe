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

bool has_limits(const AxisDescription& axis) { return std::isfinite(axis.lower) || std::isfinite(axis.upper); }

bool needs_driving(const AxisDescription& axis) {
  switch (axis.motor) {
    case MotorMode::kPosition:
      return true;
    case MotorMode::kVelocity:
      return has_limits(axis);
    case MotorMode::kNone:
      return axis.friction > 0 && axis.damping > 0;
  }
  return false;
}

double target_speed(const AxisDescription& axis, double target) {
  return std::clamp(target, -axis.max_velocity, axis.max_velocity);
}

}  // namespace

Joint::Joint(std::vector<AxisDescription> axes) {
  for (AxisDescription& description : axes) {
    if (needs_driving(description)) busy_.push_back(static_cast<int>(axes_.size()));
    axes_.push_back({std::move(description), 0, 0});
  }
}

void Joint::apply_axes() {
  for (int i = 0; i < axis_count(); ++i) {
    const AxisDescription& description = axis(i);
    if (std::isfinite(description.lower)) set_stop(i, dParamLoStop, description.lower);
    if (std::isfinite(description.upper)) set_stop(i, dParamHiStop, description.upper);
    apply_motor(i);
  }
}

void Joint::apply_motor(int index) {
  const Axis& axis = axes_[static_cast<std::size_t>(index)];
  const AxisDescription& description = axis.description;
  if (description.motor == MotorMode::kNone) {
    // A motor at rest that may slip: limited by the friction, softened by 1/damping (implicit, so stable for any
    // value).
    const bool damped = description.damping > 0 && description.friction == 0;  // for both see drive()
    set_motor(index, dParamVel, 0);
    set_motor(index, dParamFMax, damped ? dInfinity : description.friction);
    if (damped) set_motor(index, dParamCFM, 1 / description.damping);
    return;
  }
  set_motor(index, dParamFMax, std::isfinite(description.max_force) ? description.max_force : dInfinity);
  if (description.motor == MotorMode::kVelocity) {
    set_motor(index, dParamVel, target_speed(description, axis.target_velocity));
  }
}

void Joint::set_motor_mode(int axis, MotorMode mode) {
  AxisDescription& description = axes_[static_cast<std::size_t>(axis)].description;
  description.motor = mode;
  busy_.erase(std::remove(busy_.begin(), busy_.end(), axis), busy_.end());
  if (needs_driving(description)) busy_.push_back(axis);
  set_motor(axis, dParamCFM, 0);  // which a damped axis without a motor has
  apply_motor(axis);
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
  follow();
  for (const int index : busy_) drive_axis(index, step);
}

void Joint::drive_axis(int index, double step) {
  const Axis& axis = axes_[static_cast<std::size_t>(index)];
  const AxisDescription& description = axis.description;
  if (description.motor == MotorMode::kNone) {
    // A brake of the force that friction and damping have at this speed: it can stop the motion, never turn it round.
    set_motor(index, dParamFMax, description.friction + description.damping * std::abs(velocity(index)));
    return;
  }
  const double here = position(index);
  if (description.motor == MotorMode::kVelocity) {
    // Not beyond the limit: motor and stop, each of any force, would meet somewhere behind it.
    const double speed = target_speed(description, axis.target_velocity);
    const double room = speed > 0 ? description.upper - here : here - description.lower;
    set_motor(index, dParamVel, std::copysign(std::min(std::abs(speed), std::max(room, 0.0) / step), speed));
    return;
  }
  const double gap = has_limits(description)
                         ? std::clamp(axis.target_position, description.lower, description.upper) - here
                         : shortest_turn(here, axis.target_position);
  set_motor(index, dParamVel, target_speed(description, gap / std::max(kServoTime, step)));
}

ode::JointHandle separate_turning_motor(dWorldID world, const AxisDescription& axis, const Vector3& direction,
                                        dBodyID first, dBodyID second) {
  if (!has_limits(axis)) return nullptr;
  ode::JointHandle motor(dJointCreateAMotor(world, nullptr));
  dJointAttach(motor.get(), first, second);
  dJointSetAMotorNumAxes(motor.get(), 1);
  dJointSetAMotorAxis(motor.get(), 0, 1, direction.X(), direction.Y(), direction.Z());
  return motor;
}

ode::JointHandle separate_sliding_motor(dWorldID world, const AxisDescription& axis, const Vector3& direction,
                                        dBodyID first, dBodyID second) {
  if (!has_limits(axis)) return nullptr;
  ode::JointHandle motor(dJointCreateLMotor(world, nullptr));
  dJointAttach(motor.get(), first, second);
  dJointSetLMotorNumAxes(motor.get(), 1);
  dJointSetLMotorAxis(motor.get(), 0, 1, direction.X(), direction.Y(), direction.Z());
  return motor;
}

}  // namespace bubblesim
