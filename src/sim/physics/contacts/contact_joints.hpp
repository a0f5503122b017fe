// SPDX-License-Identifier: BSD-3-Clause
// ODE's contact joints, which the solvers of islands with joints use, and their forces.
#pragma once

#include "physics/contacts/substep.hpp"

namespace bubblesim {

/// Creates the joint of a point.
void join(OdeWorld& ode, const FoundPair& pair, FoundContact& point);

/// Takes the force and the torque that ODE applied.
void take_force(const FoundPair& pair, FoundContact& point);

/// Holds the links that are attached to each other, where ODE solves their islands.
void join_holds(Substep& substep);

/// Creates the joints of the contacts that were found in islands with joints.
void join_contacts(Substep& substep);

/// Stores the forces of the contacts, after the solvers.
void gather_contacts(Contacts& contacts);

}  // namespace bubblesim
