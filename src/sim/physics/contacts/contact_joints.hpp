// SPDX-License-Identifier: BSD-3-Clause
// ODE's contact joints, which the solvers of islands with joints use, and their forces.
#pragma once

#include "bubblesim/world.hpp"
#include "physics/contacts/found_contacts.hpp"

namespace bubblesim {

/// Creates the joint of a point.
void join(World::State& state, const FoundPair& pair, FoundContact& point);

/// Takes the force and the torque that ODE applied.
void take_force(const FoundPair& pair, FoundContact& point);

}  // namespace bubblesim
