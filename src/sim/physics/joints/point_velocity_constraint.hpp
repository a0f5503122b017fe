// SPDX-License-Identifier: BSD-3-Clause
// The constraint behind screws and gears, which ODE has no joints for: two bodies that touch in one point cannot move
// relative to each other along one direction there, like two teeth. What else the force along this direction does is
// held by the joints that the bodies turn or slide in.
#pragma once

#include <ode/ode.h>

#include "bubblesim/math.hpp"
#include "physics/ode_handles.hpp"

namespace bubblesim {

class PointVelocityConstraint {
 public:
  explicit PointVelocityConstraint(dWorldID world) : world_(world) {}

  /// For the next substep: the velocity of `first` relative to `second` (null: the world) at `point` along `direction`
  /// is `velocity`. All in the world, the direction of unit length.
  void hold(dBodyID first, dBodyID second, const Vector3& point, const Vector3& direction, double velocity);

 private:
  dWorldID world_;
  ode::JointHandle contact_;
};

}  // namespace bubblesim
