// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "bubblesim/error.hpp"
#include "validation/limits.hpp"

namespace bubblesim {

/// Throws InvalidInput unless a velocity in the plane, m/s and rad/s, can be commanded.
inline void check_planar_velocity(double forward, double leftward, double turning) {
  // The length of a velocity may be greater than its parts.
  if (!within(std::hypot(forward, leftward), kMaxSpeed) || !within(turning, kMaxSpeed)) {
    throw InvalidInput("the planar velocity must be finite and at most 1e6");
  }
}

}  // namespace bubblesim
