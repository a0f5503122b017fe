// SPDX-License-Identifier: BSD-3-Clause
// Simplifies meshes that are too fine for collisions: ODE takes ten microseconds for each triangle that a body may
// touch.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace bubblesim {

using CornerIndices = std::vector<std::uint32_t>;  ///< three per triangle

/// The number of triangles in the fullest cell of a grid of 1 m.
std::size_t most_in_cubic_metre(const std::vector<float>& coordinates, const CornerIndices& triangles);

/// Removes corners, first those that change the surface least, until at most `most` triangles are in any cubic metre.
/// Returns the maximum deviation of the surface in metres; the remaining corners do not move.
double simplify(const std::vector<float>& coordinates, CornerIndices& triangles, std::size_t most);

}  // namespace bubblesim
