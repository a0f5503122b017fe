// SPDX-License-Identifier: BSD-3-Clause
// Planar motion of whole models, as with omnidirectional wheels.
#pragma once

#include <ode/ode.h>

#include <array>

#include "physics/ode/ode_handles.hpp"

namespace bubblesim {

/// Holds a planar velocity of a body; has no joints in ODE until it is created.
class PlanarMotor {
 public:
  PlanarMotor() = default;
  PlanarMotor(dWorldID world, dBodyID body);

  bool exists() const { return linear_ != nullptr; }
  /// Sets its greatest force to that for a model of this mass, kg.
  void limit(double model_mass);
  /// In world axes: m/s along x and y, of the body's centre of mass, and rad/s about z.
  void set_velocity(const std::array<double, 3>& velocity);
  std::array<double, 3> velocity() const;
  /// Its greatest forces, N, and torque, N m.
  std::array<double, 3> most() const;

 private:
  ode::JointHandle linear_;
  ode::JointHandle angular_;
};

}  // namespace bubblesim
