// SPDX-License-Identifier: BSD-3-Clause
// Limits of numbers: beyond them, the physics would abort or diverge.
#pragma once

#include <cmath>

#include "bubblesim/math.hpp"

namespace bubblesim {

/// Limits of the finite world: ODE's broad phase fails a few orders of magnitude beyond.
constexpr double kMaxDistance = 1e6;      ///< m from the origin
constexpr double kMaxSize = 1e5;          ///< m, of shapes and ranges
constexpr double kMaxSpeed = 1e6;         ///< m/s and rad/s
constexpr double kMaxEffort = 1e9;        ///< N and N m, applied to a link or commanded to a joint
constexpr double kMaxGravity = 1e4;       ///< m/s^2
constexpr double kMinTimeStep = 1e-4;     ///< s, of a simulation step
constexpr double kMaxTimeStep = 10;       ///< s
constexpr double kFall = 1000;            ///< m below everything else, where fallen models are removed
constexpr double kMinPhysicsStep = 1e-5;  ///< s
constexpr double kMaxPhysicsStep = 1;     ///< s

/// False for NaN.
inline bool within(double value, double bound) { return std::abs(value) <= bound; }
inline bool within(const Vector3& v, double bound) {
  return within(v.x(), bound) && within(v.y(), bound) && within(v.z(), bound);
}

}  // namespace bubblesim
