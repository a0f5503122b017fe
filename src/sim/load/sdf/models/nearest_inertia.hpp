// SPDX-License-Identifier: BSD-3-Clause
// Corrects inertias that the physics cannot use.
#pragma once

#include <optional>

#include "bubblesim/math.hpp"

namespace bubblesim {

/// A symmetric matrix: xx, yy, zz and xy, xz, yz. kg m^2
struct Inertia {
  Vector3 diagonal;
  Vector3 products;
};

/// The nearest inertia (Frobenius norm) whose principal moments are at least a thousandth of its greatest one, like
/// those of a thin rod: the same axes, with lower moments raised to that. Empty when no moment is above zero.
std::optional<Inertia> nearest_positive_definite(const Inertia& inertia);

}  // namespace bubblesim
