// SPDX-License-Identifier: BSD-3-Clause
// Surfaces that are too fine to collide with: ODE takes ten microseconds for each triangle that a body may touch.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace bubblesim {

using CornerIndices = std::vector<std::uint32_t>;  ///< three for each triangle

/// How many triangles the fullest cell of a grid of a metre holds.
std::size_t most_in_cubic_metre(const std::vector<float>& coordinates, const CornerIndices& triangles);

/// Takes corners away, those first that change the surface least, until at most `most` triangles lie in any cubic
/// metre. Returns by how much that may move the surface, in metres; the corners that are left stay where they are.
double simplify(const std::vector<float>& coordinates, CornerIndices& triangles, std::size_t most);

}  // namespace bubblesim
