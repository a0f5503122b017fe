// SPDX-License-Identifier: BSD-3-Clause
// A row of ODE's constraints that holds the velocity of one axis with a bounded force.
#pragma once

#include <ode/ode.h>

#include "bubblesim/math.hpp"
#include "physics/ode/ode_handles.hpp"

namespace bubblesim {

/// Axis of a motor: motion of the first body relative to the second is positive along `direction`.
struct AxisLine {
  Vector3 direction;  ///< world axes, unit length
  dBodyID first = nullptr;
  dBodyID second = nullptr;
  int carrier = 1;  ///< the body that the direction is fixed in: 1 the first, 2 the second
};

/// What a motor does in a substep.
struct MotorForce {
  double velocity = 0;   ///< m/s or rad/s, of the first body relative to the second
  double max_force = 0;  ///< N or N m
  double softness = 0;   ///< velocity that a unit of force lets through
};

class Motor {
 public:
  using SetParameter = void (*)(dJointID, int, dReal);

  /// The rows of `joint` for one of its axes; `group` is ODE's index of that axis, from 0.
  Motor(dJointID joint, SetParameter set, int group) : joint_(joint), set_(set), group_(group) {}
  /// A separate motor joint between the same bodies.
  static Motor turning(dWorldID world, const AxisLine& line);
  static Motor sliding(dWorldID world, const AxisLine& line);

  /// The ODE joint with the row.
  dJointID joint() const { return joint_; }
  /// Sets an ODE parameter dParam..., given without the offset of the group.
  void set(int parameter, double value) const { set_(joint_, group_ * dParamGroup + parameter, value); }

  /// Turns the axis of a separate motor joint that turns, in the world.
  void turn(const Vector3& direction) const;

  /// What it was set to.
  const MotorForce& force() const { return force_; }

  /// Holds `velocity` with a force of at most `max_force` (N or N m), which may be infinite.
  void hold(double velocity, double max_force);
  /// Changes the velocity that it holds.
  void aim(double velocity);
  /// Applies a force of `coefficient` (N s/m or N m s/rad) times the difference to `velocity`. Uses the velocity at the
  /// end of the step, so any coefficient is stable.
  void damp(double velocity, double coefficient);

 private:
  using SetAxis = void (*)(dJointID, int, int, dReal, dReal, dReal);
  static Motor between(const AxisLine& line, ode::JointHandle joint, SetAxis set_axis, SetParameter set);

  ode::JointHandle own_;  // null when the rows are part of another joint
  dJointID joint_;
  SetParameter set_;
  int group_;
  MotorForce force_;  // ODE is slow to ask
};

}  // namespace bubblesim
