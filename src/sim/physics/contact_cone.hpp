// SPDX-License-Identifier: BSD-3-Clause
// Coulomb's friction from the loads that act, for ODE's contact joints: see docs/adr/0024.
#pragma once

#include "physics/contact_memory.hpp"

namespace bubblesim {

/// Limits the friction of the points of a pair by the normal forces of the last substep, where they are settled, and
/// lays the first friction direction along the friction that acts. A point without a past keeps ODE's first
/// approximation, whose limits follow from the normal forces without friction; `iterative` points do as well, because
/// the iterative solver computes limits from the forces that act.
void limit_friction(const FoundPair& pair, const RememberedPair* remembered, const ContactMemory& memory, double step,
                    bool iterative, FoundContact* points);

}  // namespace bubblesim
