// SPDX-License-Identifier: BSD-3-Clause
// Inertias that no physics can use, and what is nearest to them.
#pragma once

#include <optional>

#include "bubblesim/math.hpp"

namespace bubblesim {

/// A symmetric matrix: xx, yy, zz and xy, xz, yz. kg m^2
struct Inertia {
  Vector3 diagonal;
  Vector3 products;
};

/// The inertia nearest to it (Frobenius norm) of those whose principal moments are a thousandth of its greatest or
/// more, as those of a thin rod: the same axes, with the moments below raised to that. Nothing when no moment is above
/// zero.
std::optional<Inertia> nearest_positive_definite(const Inertia& inertia);

}  // namespace bubblesim
