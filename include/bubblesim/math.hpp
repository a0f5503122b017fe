// SPDX-License-Identifier: BSD-3-Clause
// Vectors, quaternions and poses on Eigen. SI units, x forward, z up (REP 103).
//
// They differ from Eigen's own types in two ways: they start as zero and as identity, and quaternions have the same
// alignment whatever instruction set a program is compiled for. Eigen's expressions convert to them; `auto` keeps the
// expression, which may refer to temporaries: name the type instead.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace bubblesim {

using Matrix3 = Eigen::Matrix3d;

struct Vector3 : Eigen::Vector3d {
  Vector3() : Eigen::Vector3d(0, 0, 0) {}
  Vector3(double x, double y, double z) : Eigen::Vector3d(x, y, z) {}
  template <class Derived>
  Vector3(const Eigen::MatrixBase<Derived>& other) : Eigen::Vector3d(other) {}  // NOLINT: as Eigen's own
  template <class Derived>
  Vector3& operator=(const Eigen::MatrixBase<Derived>& other) {
    Eigen::Vector3d::operator=(other);
    return *this;
  }
};

/// A rotation, of unit length. Constructed as (w, x, y, z); shown to users, and stored in coeffs(), as x, y, z, w.
struct Quaternion : Eigen::Quaternion<double, Eigen::DontAlign> {
  using Base = Eigen::Quaternion<double, Eigen::DontAlign>;
  Quaternion() : Base(1, 0, 0, 0) {}
  Quaternion(double w, double x, double y, double z) : Base(w, x, y, z) {}
  explicit Quaternion(const Eigen::AngleAxisd& rotation) : Base(rotation) {}
  explicit Quaternion(const Matrix3& matrix) : Base(matrix) {}
  template <class Derived>
  Quaternion(const Eigen::QuaternionBase<Derived>& other) : Base(other) {}  // NOLINT: as Eigen's own
};

/// Fixed-axis rotations about x, then y, then z: R = Rz(yaw) Ry(pitch) Rx(roll), as in SDFormat and URDF. rad
Quaternion from_rpy(double roll, double pitch, double yaw);

/// The inverse of from_rpy(): roll, pitch and yaw, pitch from -pi/2 to pi/2; at those, the roll is 0.
Vector3 to_rpy(const Quaternion& rotation);

/// The shortest rotation from the z axis to a direction, which is not zero; to -z, about x.
Quaternion turn_from_z(const Vector3& direction);

/// A rigid transform from one frame to another: `a * b` is b given in the frame of a.
struct Pose {
  Vector3 position;
  Quaternion orientation;

  Pose() = default;
  Pose(const Vector3& position, const Quaternion& orientation) : position(position), orientation(orientation) {}
  Pose(double x, double y, double z, double roll, double pitch, double yaw)
      : position(x, y, z), orientation(from_rpy(roll, pitch, yaw)) {}

  Pose inverse() const {
    const Quaternion back = orientation.conjugate();
    return {-(back * position), back};
  }
};

inline Pose operator*(const Pose& frame, const Pose& inner) {
  return {frame.position + frame.orientation * inner.position, frame.orientation * inner.orientation};
}
/// A point of the inner frame in the outer one.
inline Vector3 operator*(const Pose& frame, const Vector3& point) { return frame.position + frame.orientation * point; }

/// To the last bit.
inline bool operator==(const Pose& a, const Pose& b) {
  return a.position == b.position && a.orientation.coeffs() == b.orientation.coeffs();
}
inline bool operator!=(const Pose& a, const Pose& b) { return !(a == b); }

struct Twist {
  Vector3 linear;   ///< m/s, world axes
  Vector3 angular;  ///< rad/s, world axes
};

}  // namespace bubblesim
