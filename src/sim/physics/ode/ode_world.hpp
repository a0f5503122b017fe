// SPDX-License-Identifier: BSD-3-Clause
// ODE's world: bodies, joints and contact joints, and the random numbers of its iterative solver.
#pragma once

#include <ode/ode.h>

#include <cstdint>

#include "bubblesim/math.hpp"
#include "physics/ode/ode_handles.hpp"

namespace bubblesim {

/// Members are destroyed in reverse order: the contact joints before the world, its threading last.
struct OdeWorld {
  OdeWorld(const Vector3& gravity, std::uint64_t seed);

  dWorldID id() const { return world.get(); }

  ode::ThreadingHandle threading;
  ode::WorldHandle world;
  ode::JointGroupHandle contact_joints;  // of the last substep
  unsigned long random;                  // state of the iterative solver
};

}  // namespace bubblesim
