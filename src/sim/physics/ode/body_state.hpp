// SPDX-License-Identifier: BSD-3-Clause
// The state of one of ODE's bodies, to the bit.
#pragma once

#include <ode/ode.h>

#include <array>

#include "bubblesim/math.hpp"
#include "bubblesim/state_archive.hpp"

namespace bubblesim {

/// Position, quaternion w x y z, velocities, and force and torque of the next substep.
using BodyNumbers = std::array<dReal, 19>;

/// Of the centre of mass; without normalizing the quaternion once more, as dBodySetQuaternion() does.
void set_body_pose(dBodyID body, const Pose& pose);

BodyNumbers numbers_of(dBodyID body);
void set_numbers(dBodyID body, const BodyNumbers& numbers);

/// Saves or restores pose, velocities, forces of the next substep, and whether the body sleeps. Throws InvalidInput for
/// values with which ODE would end the process.
void transfer_body(StateArchive& archive, dBodyID body);

}  // namespace bubblesim
