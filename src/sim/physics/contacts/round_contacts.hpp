// SPDX-License-Identifier: BSD-3-Clause
// Contact points of round shapes, at their radius: a wheel rolls with its radius however much shapes overlap.
#pragma once

#include <ode/ode.h>

namespace bubblesim {

/// Moves the points of a sphere, a capsule or the side of a cylinder against a shape that is not round there along
/// their normals onto the surface of the round shape. Against planes, ODE's points are there.
void place_on_round_shape(dGeomID first, dGeomID second, int count, dContactGeom* points);

}  // namespace bubblesim
