// SPDX-License-Identifier: BSD-3-Clause
// Where two shapes touch, in a few points that hold them.
#pragma once

#include <ode/ode.h>

#include <array>
#include <cstddef>
#include <vector>

namespace bubblesim {

constexpr int kMaxContactsPerPair = 8;
using ContactPoints = std::array<dContactGeom, kMaxContactsPerPair>;

/// Returns how many there are.
int find_contact_points(dGeomID first, dGeomID second, ContactPoints& points);

/// Which `most` of more points lie apart: the deepest, then each time the one farthest from those taken.
std::vector<std::size_t> spread(const std::vector<dContactGeom>& points, std::size_t most);

}  // namespace bubblesim
