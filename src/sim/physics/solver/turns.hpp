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

/// The part of a rotation about a unit axis.
inline Quaternion turn_about(const Vector3& axis, const Quaternion& turn) {
  const double sine = axis.dot(turn.vec());
  const double length = std::sqrt(sine * sine + turn.w() * turn.w());
  if (length == 0) return {};
  const Vector3 part = axis * (sine / length);
  return {turn.w() / length, part.x(), part.y(), part.z()};
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
