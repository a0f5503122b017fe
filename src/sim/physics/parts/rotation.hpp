// SPDX-License-Identifier: BSD-3-Clause
// The rotation of a body with unequal moments of inertia. ODE's own gyroscopic torque is implicit and of first order:
// it damps the rotation. This one is of second order and exact in the angular momentum.
#pragma once

#include <ode/ode.h>

#include "bubblesim/math.hpp"
#include "bubblesim/state_archive.hpp"

namespace bubblesim {

class Rotation {
 public:
  /// `body` must live as long as this object, with ODE's gyroscopic mode off and its finite rotations on.
  explicit Rotation(dBodyID body);

  /// Whether a body has unequal moments of inertia. Others rotate as ODE has it.
  static bool is_needed(dBodyID body);

  /// Call before a substep of `step` seconds, when the forces are applied and the contacts exist.
  void begin(double step);
  /// Call after it.
  void end(double step);

  /// Call after the moments of inertia of the body were multiplied by a factor.
  void scale(double factor);

  dBodyID body() const { return body_; }
  /// State beside that of the body: the angular momentum that it is ahead of its forces, kg m^2/s, world axes.
  const Vector3& ahead() const { return ahead_; }
  void transfer(StateArchive& archive);

 private:
  void turn_freely(double step);
  Vector3 implicit_change(const Vector3& momentum, double step) const;
  bool was_moved() const;

  dBodyID body_;
  Matrix3 inertia_;  // body axes
  Matrix3 inverse_;
  bool free_ = false;         // in this substep it has no joint or contact, and does not rotate about a principal axis
  bool constrained_ = false;  // in this substep it has, and is rotated by the torque of begin()
  Vector3 ahead_;
  double step_ = 0;            // s, of the last substep
  dQuaternion orientation_{};  // at the start of a substep of free motion, at the end of a constrained one
  dVector3 velocity_{};        // at the end of a constrained substep
};

}  // namespace bubblesim
