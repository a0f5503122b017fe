// SPDX-License-Identifier: BSD-3-Clause
// Fast bodies do not pass through others within a substep: a model stops where one of its links first touches another
// body, with its velocity, and the contact acts in the next substep.
#pragma once

#include "physics/contacts/substep.hpp"

namespace bubblesim {

/// Includes a shape of a link in its sizes. A mesh that collides as triangles is not tested.
void measure(const Collider& collider, Sweep& sweep);

/// Call before and after the step of the solver. Links are tested that moved by more than half their smallest size.
void note_motion(const MovingModels& moving);
void stop_at_impacts(Substep& substep);

}  // namespace bubblesim
