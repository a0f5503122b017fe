// SPDX-License-Identifier: BSD-3-Clause
// Which part of the errors of joints a substep corrects; contacts have their own part.
#pragma once

#include <ode/ode.h>

#include "physics/parts/placed_model.hpp"

namespace bubblesim {

/// Adds a body of a joint at `anchor`, in the world, to the levers of its model.
void note_lever(PlacedModel& model, dBodyID body, const Vector3& anchor);

/// Sets the part of the errors of joints that the next substep of `step` seconds corrects.
void correct_joints(const MovingModels& moving, dWorldID world, double step);

}  // namespace bubblesim
