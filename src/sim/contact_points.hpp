// SPDX-License-Identifier: BSD-3-Clause
// Where two shapes touch, in a few points that hold them.
#pragma once

#include <ode/ode.h>

#include <array>

namespace bubblesim {

constexpr int kMaxContactsPerPair = 8;
using ContactPoints = std::array<dContactGeom, kMaxContactsPerPair>;

/// Returns how many there are.
int find_contact_points(dGeomID first, dGeomID second, ContactPoints& points);

}  // namespace bubblesim
