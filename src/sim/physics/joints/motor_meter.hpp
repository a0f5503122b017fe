// SPDX-License-Identifier: BSD-3-Clause
// Measures the effort of an axis's motor.
#pragma once

#include <ode/ode.h>

#include "bubblesim/math.hpp"
#include "bubblesim/state_archive.hpp"

namespace bubblesim {

/// What a meter must know of an axis, at the poses of the bodies when it is created.
struct MeteredAxis {
  dJointID joint = nullptr;  ///< ODE's joint with the motor
  dBodyID child = nullptr;
  dBodyID carrier = nullptr;  ///< the body in which the axis is fixed; null is the world
  Vector3 direction;          ///< world axes, unit length
  Vector3 origin;             ///< of the joint, in the world
  bool slides = false;
};

/// ODE's joint keeps a pointer to the feedback.
class MotorMeter {
 public:
  explicit MotorMeter(const MeteredAxis& axis);
  MotorMeter(const MotorMeter&) = delete;
  MotorMeter& operator=(const MotorMeter&) = delete;

  /// Call when the axis has got another direction or origin, in the world.
  void place(const Vector3& direction, const Vector3& origin);
  /// Call before a substep: ODE's forces refer to the positions at its start.
  void aim();
  /// Call after a substep of `step` seconds.
  void gather(double step);
  /// Adds what a motor did that is not ODE's, N s or N m s on the child.
  void add(double impulse) { impulse_ += impulse; }
  void clear() { impulse_ = 0; }
  /// Of the motor on the child since clear(), N s or N m s.
  double impulse() const { return impulse_; }
  void transfer(StateArchive& archive) { archive(impulse_); }

 private:
  MeteredAxis axis_;
  bool child_first_;  // ODE's first force acts on the child
  Vector3 direction_in_carrier_;
  Vector3 lever_in_child_;  // from the joint's origin to the child's centre of mass
  Vector3 direction_;       // world axes, at the start of the substep
  Vector3 lever_;
  dJointFeedback feedback_{};
  double impulse_ = 0;
};

}  // namespace bubblesim
