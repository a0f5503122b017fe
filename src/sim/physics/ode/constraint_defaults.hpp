// SPDX-License-Identifier: BSD-3-Clause
// Defaults of contacts and joints. Measured on wheeled robots: an error correction and softness that keep turning
// radius and distance exact, and a limit on the speed at which overlapping shapes are pushed apart; without it badly
// placed shapes fly off.
#pragma once

namespace bubblesim {

constexpr double kErrorReduction = 0.2;         ///< fraction of an error that a substep corrects
constexpr double kConstraintSoftness = 1e-10;   ///< m/s/N
constexpr double kLoadSharing = 2e-3;           ///< softness of a contact times the mass, divided by the substep
constexpr double kMaxCorrectingVelocity = 0.1;  ///< m/s
constexpr double kSurfaceLayer = 0.001;         ///< m, overlap of touching shapes at rest
constexpr double kRigid = 1e12;                 ///< N/m, of a surface without a stiffness

}  // namespace bubblesim
