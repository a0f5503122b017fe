// SPDX-License-Identifier: BSD-3-Clause
// The constraint of screws and gears, for which ODE has no joints: at one point, two bodies have a given relative
// velocity along one direction, like meshing teeth. The joints of the bodies hold the other effects of the force.
#pragma once

#include <ode/ode.h>

#include "bubblesim/math.hpp"
#include "physics/ode/ode_handles.hpp"

namespace bubblesim {

class PointVelocityConstraint {
 public:
  explicit PointVelocityConstraint(dWorldID world) : world_(world) {}

  /// For the next substep, makes `velocity` the velocity of `first` relative to `second` (null: the world) at `point`
  /// along `direction`. World frame; unit direction.
  void hold(dBodyID first, dBodyID second, const Vector3& point, const Vector3& direction, double velocity);

 private:
  dWorldID world_;
  ode::JointHandle contact_;
};

}  // namespace bubblesim
