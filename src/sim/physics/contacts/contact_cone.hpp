// SPDX-License-Identifier: BSD-3-Clause
// Coulomb's friction from the loads that act, for ODE's contact joints: see docs/adr/0024.
#pragma once

#include "physics/contacts/contact_memory.hpp"

namespace bubblesim {

/// Limits the friction of the points of a pair by the normal forces of the last substep, where they are settled, and
/// lays the first friction direction along the friction that acts. A point without a past keeps ODE's first
/// approximation, whose limits follow from the normal forces without friction; `iterative` points do as well, because
/// the iterative solver computes limits from the forces that act.
void limit_friction(const FoundPair& pair, const RememberedPair* remembered, const ContactMemory& memory, double step,
                    bool iterative, FoundContact* points);

/// Likewise by another normal force in N, and along the force of the last solution.
void limit_friction(const FoundPair& pair, double normal, FoundContact& point);

/// The normal force in N that the tangential force of a contact needs.
double needed_normal(const FoundContact& point);

/// Whether the shapes slide on each other at a point.
bool slides(const FoundPair& pair, const FoundContact& point);

}  // namespace bubblesim
