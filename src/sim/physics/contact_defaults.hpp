// SPDX-License-Identifier: BSD-3-Clause
// How contacts and joints give when a file does not say it. Measured on wheeled robots: error correction and softness
// that keep turning radius and distance exact, and a limit on how fast overlapping shapes are pushed apart, without
// which badly placed ones fly off.
#pragma once

namespace bubblesim {

constexpr double kErrorReduction = 0.2;         ///< part of an error that a step takes away
constexpr double kConstraintSoftness = 1e-10;   ///< m/s/N
constexpr double kMaxCorrectingVelocity = 0.1;  ///< m/s
constexpr double kSurfaceLayer = 0.001;         ///< m that shapes in touch overlap at rest
constexpr double kRigid = 1e12;                 ///< N/m, of a surface that has no stiffness of its own

}  // namespace bubblesim
