// SPDX-License-Identifier: BSD-3-Clause
// Contact points of two shapes, reduced to a few that hold them.
#pragma once

#include <ode/ode.h>

#include <array>
#include <cstddef>
#include <vector>

namespace bubblesim {

constexpr int kMaxContactsPerPair = 8;
using ContactPoints = std::array<dContactGeom, kMaxContactsPerPair>;

/// Returns the number of points.
int find_contact_points(dGeomID first, dGeomID second, ContactPoints& points);

/// Selects `most` points that are far apart: the deepest, then repeatedly the one farthest from those selected.
std::vector<std::size_t> spread(const std::vector<dContactGeom>& points, std::size_t most);

}  // namespace bubblesim
