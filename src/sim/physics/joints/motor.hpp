// SPDX-License-Identifier: BSD-3-Clause
// A row of ODE's constraints that holds the velocity of one axis with a bounded force.
#pragma once

#include <ode/ode.h>

#include "bubblesim/math.hpp"
#include "physics/ode_handles.hpp"

namespace bubblesim {

/// What ODE needs to know of an axis: the first body's motion relative to the second's is positive along `direction`.
struct AxisLine {
  Vector3 direction;  ///< world axes, unit length
  dBodyID first = nullptr;
  dBodyID second = nullptr;
  int carrier = 1;  ///< the body that the direction is fixed in: 1 the first, 2 the second
};

class Motor {
 public:
  using SetParameter = void (*)(dJointID, int, dReal);

  /// The rows that `joint` has itself for one of its axes; `group` is ODE's number of that axis, from 0.
  Motor(dJointID joint, SetParameter set, int group) : joint_(joint), set_(set), group_(group) {}
  /// A joint of its own between the same bodies.
  static Motor turning(dWorldID world, const AxisLine& line);
  static Motor sliding(dWorldID world, const AxisLine& line);

  /// ODE's joint that has the row.
  dJointID joint() const { return joint_; }
  /// Sets one of ODE's parameters dParam..., without the offset of the group.
  void set(int parameter, double value) const { set_(joint_, group_ * dParamGroup + parameter, value); }

  /// Holds `velocity` with a force of at most `max_force`, N or N m, which may be infinite.
  void hold(double velocity, double max_force) const;
  /// Pulls towards `velocity` by `coefficient` times what it differs, N s/m or N m s/rad. The velocity at the end of
  /// the step counts, so that any coefficient is stable.
  void damp(double velocity, double coefficient) const;

 private:
  using SetAxis = void (*)(dJointID, int, int, dReal, dReal, dReal);
  static Motor between(const AxisLine& line, ode::JointHandle joint, SetAxis set_axis, SetParameter set);

  ode::JointHandle own_;  // null when the rows are part of another joint
  dJointID joint_;
  SetParameter set_;
  int group_;
};

}  // namespace bubblesim
