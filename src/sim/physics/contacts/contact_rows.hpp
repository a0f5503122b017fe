// SPDX-License-Identifier: BSD-3-Clause
// Directions in which impulses of a contact act, and a disc of two of them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bubblesim/math.hpp"

namespace bubblesim {

/// A velocity and a spin, or an impulse and its moment, at the origin of a pair of bodies.
using SpatialVector = Eigen::Matrix<double, 6, 1>;

/// The matrix of the cross product: cross_matrix(v) * w is v x w.
inline Matrix3 cross_matrix(const Vector3& v) {
  return Matrix3{{0, -v.z(), v.y()}, {v.z(), 0, -v.x()}, {-v.y(), v.x(), 0}};
}

/// A direction in which an impulse acts between two bodies.
struct SolvedRow {
  SpatialVector along =
      SpatialVector::Zero();  // the impulse on the first body and its moment in m, per impulse; 0 and an axis
  SpatialVector effect =
      SpatialVector::Zero();  // on the motion of the first body relative to the second, per impulse: 1/kg, 1/(kg m)
  double admittance = 0;      // 1/kg, relative velocity per impulse; with the softness
  double softness = 0;        // 1/kg, part of the admittance: velocity that an impulse lets through
  double inverse = 0;         // kg, of the admittance
  double impulse = 0;         // N s
};

/// How two perpendicular rows affect each other.
struct Coupling {
  std::array<double, 3> inverse{};  // kg, of the admittance: first, mixed, second
  double slide = 0;                 // kg, the least inverse of the admittance in any direction
};

inline Coupling couple(const std::array<SolvedRow, 2>& rows) {
  const auto& [first, second] = rows;
  const double mixed = second.along.dot(first.effect);  // 1/kg, velocity along the second per impulse along the first
  const double determinant = first.admittance * second.admittance - mixed * mixed;
  const double half = (first.admittance - second.admittance) / 2;
  return {{second.admittance / determinant, -mixed / determinant, first.admittance / determinant},
          1 / (first.admittance - half + std::sqrt(half * half + mixed * mixed))};
}

/// The impulses that end the velocities `v1` and `v2` of two rows.
inline std::array<double, 2> stick(const std::array<SolvedRow, 2>& rows, const Coupling& by, double v1, double v2) {
  return {rows[0].impulse - (by.inverse[0] * v1 + by.inverse[1] * v2),
          rows[1].impulse - (by.inverse[1] * v1 + by.inverse[2] * v2)};
}

/// Likewise, but at most `limit` together.
inline std::array<double, 2> stick_within(const std::array<SolvedRow, 2>& rows, const Coupling& by, double v1,
                                          double v2, double limit) {
  const auto square = [](const std::array<double, 2>& p) { return p[0] * p[0] + p[1] * p[1]; };
  std::array<double, 2> p = stick(rows, by, v1, v2);
  if (square(p) <= limit * limit) return p;
  // A slide: a step along the velocity, since friction opposes it, and back to the disc.
  p = {rows[0].impulse - v1 * by.slide, rows[1].impulse - v2 * by.slide};
  const double scale = limit / std::max({std::sqrt(square(p)), limit, std::numeric_limits<double>::min()});
  return {p[0] * scale, p[1] * scale};
}

}  // namespace bubblesim
