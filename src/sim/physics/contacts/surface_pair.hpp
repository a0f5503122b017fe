// SPDX-License-Identifier: BSD-3-Clause
// Combines the parameters of two touching surfaces, like Gazebo.
#pragma once

#include <ode/ode.h>

#include "bubblesim/scene.hpp"

namespace bubblesim {

struct SurfacePair {
  dSurfaceParameters ode{};
  double torsion_by_depth = 0;        ///< m^0.5, see Surface
  const Surface* directed = nullptr;  ///< the surface whose fdir1 is used; null when none has a direction
  bool has_own_correction = false;    ///< a stiffness or an error correction is given
  double sink = 0;                    ///< m, allowed penetration depth
  double sink_speed = 0;              ///< m/s, maximum sinking speed of a rigid contact; 0: not actively sunk
  double least_softness = 0;          ///< of a rigid contact with a stiffness, m/s per N
  double max_depth = 0;               ///< m; deeper overlaps are clamped to this, so that bodies do not fly apart
};

/// For a substep of `step` seconds.
SurfacePair combine(const Surface& a, const Surface& b, double step);

/// The solvers take no infinite coefficient of friction.
double bounded_friction(double coefficient);

/// Makes a contact without softness or restitution of its own yield a little, so that points share the load where rigid
/// ones would leave it open which of them bears it. `inverse_mass` in 1/kg is the sum of those of the two outermost
/// models.
void share_load(double inverse_mass, double step, SurfacePair& pair);

}  // namespace bubblesim
