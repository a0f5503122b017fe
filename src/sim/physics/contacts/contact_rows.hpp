// SPDX-License-Identifier: BSD-3-Clause
// Directions in which impulses of a contact act, and a disc of two of them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bubblesim/math.hpp"

namespace bubblesim {

/// A direction in which an impulse acts on two bodies.
struct SolvedRow {
  Vector3 direction;           // of the force on the first body; zero for torques
  Vector3 arm_a, arm_b;        // torque on each body per impulse, m (1 for torques)
  Vector3 turned_a, turned_b;  // their effect on the spins, 1/(kg m)
  double admittance = 0;       // 1/kg, relative velocity per impulse; with the softness
  double softness = 0;         // 1/kg, part of the admittance: velocity that an impulse lets through
  double impulse = 0;          // N s
};

/// How two perpendicular rows affect each other.
struct Coupling {
  double mixed = 0;        // 1/kg, velocity along the second per impulse along the first
  double determinant = 0;  // 1/kg^2, of the admittances
  double slide = 0;        // kg, the least inverse of the admittance in any direction
};

inline Coupling couple(const std::array<SolvedRow, 2>& rows) {
  const auto& [first, second] = rows;
  Coupling made;
  made.mixed = second.arm_a.dot(first.turned_a) + second.arm_b.dot(first.turned_b);
  made.determinant = first.admittance * second.admittance - made.mixed * made.mixed;
  const double half = (first.admittance - second.admittance) / 2;
  made.slide = 1 / (first.admittance - half + std::hypot(half, made.mixed));
  return made;
}

/// The impulses that end the velocities `v1` and `v2` of two rows.
inline std::array<double, 2> stick(const std::array<SolvedRow, 2>& rows, const Coupling& by, double v1, double v2) {
  const auto& [first, second] = rows;
  return {first.impulse - (second.admittance * v1 - by.mixed * v2) / by.determinant,
          second.impulse - (first.admittance * v2 - by.mixed * v1) / by.determinant};
}

/// Likewise, but at most `limit` together.
inline std::array<double, 2> stick_within(const std::array<SolvedRow, 2>& rows, const Coupling& by, double v1,
                                          double v2, double limit) {
  std::array<double, 2> p = stick(rows, by, v1, v2);
  if (std::hypot(p[0], p[1]) <= limit) return p;
  // A slide: a step along the velocity, since friction opposes it, and back to the disc.
  p = {rows[0].impulse - v1 * by.slide, rows[1].impulse - v2 * by.slide};
  const double scale = limit / std::max({std::hypot(p[0], p[1]), limit, std::numeric_limits<double>::min()});
  return {p[0] * scale, p[1] * scale};
}

}  // namespace bubblesim
