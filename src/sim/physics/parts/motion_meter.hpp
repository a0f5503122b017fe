// SPDX-License-Identifier: BSD-3-Clause
// What an inertial measurement unit measures, substep by substep, in its own axes at the time of each.
#pragma once

#include <ode/ode.h>

#include "bubblesim/math.hpp"
#include "physics/parts/substep_signal.hpp"

namespace bubblesim {

/// Where a body was when the forces of a substep acted on it, by its solver.
enum class ForcePlace {
  kStart,    ///< ODE's
  kOnTheWay  ///< trees: velocities are those at the places before and after
};

class MotionMeter {
 public:
  /// `in_body`: pose of the unit relative to the body's centre of mass and axes.
  MotionMeter(dBodyID body, const Pose& in_body, double bandwidth)
      : body_(body),
        in_body_(in_body),
        bandwidth_(bandwidth),
        specific_force_(bandwidth),
        angular_velocity_(bandwidth) {}

  void clear();
  /// Call before and after each substep.
  void begin();
  void end(double step, const Vector3& gravity, ForcePlace place);

  void transfer(StateArchive& archive) { archive(specific_force_, angular_velocity_); }

  bool has_value() const { return specific_force_.has_value(); }
  /// Acceleration minus gravity at the unit, m/s^2.
  Vector3 specific_force() const { return specific_force_.value(); }
  /// rad/s: at present, or filtered with a bandwidth.
  Vector3 angular_velocity() const;

 private:
  dBodyID body_;
  Pose in_body_;
  double bandwidth_;
  SubstepSignal specific_force_;
  SubstepSignal angular_velocity_;
  Quaternion orientation_;  // of the unit, at the start of the substep
  Vector3 lever_;           // from the centre of mass, likewise, world axes
  Twist before_;            // of the centre of mass
};

}  // namespace bubblesim
