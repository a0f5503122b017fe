// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bubblesim/math.hpp"

namespace bubblesim {

/// The inertia of a point mass of 1 kg at an offset (parallel-axis theorem). m^2
inline Matrix3 unit_steiner(const Vector3& offset) {
  return offset.squaredNorm() * Matrix3::Identity() - offset * offset.transpose();
}

}  // namespace bubblesim
