// SPDX-License-Identifier: BSD-3-Clause
// Rotations about axes of joints.
#pragma once

#include <cmath>

#include "bubblesim/math.hpp"

namespace bubblesim {

/// The rotation about a unit axis by an angle in rad.
inline Quaternion turn_about(const Vector3& axis, double angle) {
  const Vector3 part = axis * std::sin(angle / 2);
  return {std::cos(angle / 2), part.x(), part.y(), part.z()};
}

/// One over the root of a square, without root and division where it is nearly 1.
inline double inverse_length(double square) {
  const double beyond = square - 1;
  return std::abs(beyond) < 1e-8 ? 1 - beyond / 2 : 1 / std::sqrt(square);
}

/// The rotation about a unit axis by twice the angle of which these are parts, but for a factor, of cosine and sine.
inline Quaternion turn_of_parts(const Vector3& axis, double cosine, double sine) {
  const double square = sine * sine + cosine * cosine;
  if (square == 0) return {};
  const double factor = inverse_length(square);
  const Vector3 part = axis * (sine * factor);
  return {cosine * factor, part.x(), part.y(), part.z()};
}

/// As Quaternion::normalized(), faster where the length is nearly 1.
inline Quaternion normalized(const Quaternion& turn) {
  Quaternion made;
  made.coeffs() = turn.coeffs() * inverse_length(turn.squaredNorm());
  return made;
}

/// The rotation by a vector in rad.
inline Quaternion turn_by(const Vector3& angle) {
  const double size = angle.norm();
  return size == 0 ? Quaternion() : turn_about(angle / size, size);
}

/// The angle from one vector to another about a unit axis, rad.
inline double angle_about(const Vector3& axis, const Vector3& from, const Vector3& to) {
  return std::atan2(axis.dot(from.cross(to)), from.dot(to) - axis.dot(from) * axis.dot(to));
}

}  // namespace bubblesim
