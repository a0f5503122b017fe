// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bubblesim/math.hpp"

namespace bubblesim {

/// A rigid transform like Pose. The rotation is a matrix, which turns vectors faster than a quaternion.
struct Transform {
  Vector3 position;
  Matrix3 rotation = Matrix3::Identity();

  Transform() = default;
  Transform(const Vector3& position, const Matrix3& rotation) : position(position), rotation(rotation) {}
  explicit Transform(const Pose& pose) : position(pose.position), rotation(pose.orientation.toRotationMatrix()) {}

  Transform inverse() const { return {-(rotation.transpose() * position), rotation.transpose()}; }
};

inline Vector3 operator*(const Transform& frame, const Vector3& point) {
  return frame.position + frame.rotation * point;
}
inline Transform operator*(const Transform& frame, const Transform& inner) {
  return {frame * inner.position, frame.rotation * inner.rotation};
}

}  // namespace bubblesim
