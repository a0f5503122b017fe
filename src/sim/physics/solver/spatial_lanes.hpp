// SPDX-License-Identifier: BSD-3-Clause
// Motions and forces of rigid bodies in groups of four numbers, for loops that are compiled for several instruction
// sets (scene/simd.hpp). The fourth number of a vector is 0.
#pragma once

#include <Eigen/Core>

#include "bubblesim/math.hpp"
#include "physics/solver/four.hpp"

namespace bubblesim {

BUBBLESIM_INLINE Four lanes_of(const Vector3& v) { return Four{v.x(), v.y(), v.z(), 0}; }
BUBBLESIM_INLINE Four lanes_of(const double* vector) { return Four{vector[0], vector[1], vector[2], 0}; }
BUBBLESIM_INLINE Vector3 vector_of(const Four& v) { return {v[0], v[1], v[2]}; }

BUBBLESIM_INLINE Four lanes_of(const Quaternion& turn) { return Four{turn.x(), turn.y(), turn.z(), turn.w()}; }

/// Some of the numbers of a group, and its fourth.
template <int a, int b, int c>
BUBBLESIM_INLINE Four lanes(const Four& of) {
  return Four{of[a], of[b], of[c], of[3]};
}
BUBBLESIM_INLINE double lanes_dot(const Four& a, const Four& b) {
  const Four parts = a * b;
  return parts[0] + parts[1] + parts[2];
}
BUBBLESIM_INLINE Four cross(const Four& a, const Four& b) {
  const Four next_a{a[1], a[2], a[0], a[3]};
  const Four next_b{b[1], b[2], b[0], b[3]};
  const Four turned = a * next_b - next_a * b;
  return Four{turned[1], turned[2], turned[0], turned[3]};
}

/// Of quaternions, whose w is the fourth number.
BUBBLESIM_INLINE Four turn_product(const Four& a, const Four& b) {
  const Four w = a[3] * b;
  const Four same{a[0] * b[3], a[1] * b[3], a[2] * b[3], -a[0] * b[0]};
  const Four next{a[1] * b[2], a[2] * b[0], a[0] * b[1], -a[1] * b[1]};
  const Four last{-a[2] * b[1], -a[0] * b[2], -a[1] * b[0], -a[2] * b[2]};
  return (w + same) + (next + last);
}
BUBBLESIM_INLINE Four turn_back(const Four& a) { return Four{-a[0], -a[1], -a[2], a[3]}; }
BUBBLESIM_INLINE double turn_dot(const Four& a, const Four& b) {
  const Four parts = a * b;
  return (parts[0] + parts[1]) + (parts[2] + parts[3]);
}

/// A matrix by columns; at first the identity.
struct MatrixLanes {
  Four columns[3] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};

  BUBBLESIM_INLINE Four operator*(const Four& v) const {
    return columns[0] * v[0] + columns[1] * v[1] + columns[2] * v[2];
  }
  /// The axes that a quaternion of unit length turns to. In groups: what is stored number by number is slow to read.
  BUBBLESIM_INLINE void set_turn(const Four& turn) {
    const Four twice = turn * 2;
    columns[0] = Four{1, 0, 0, 0} + (lanes<1, 0, 0>(twice) * lanes<1, 1, 2>(turn) * Four{-1, 1, 1, 0} +
                                     lanes<2, 2, 1>(twice) * lanes<2, 3, 3>(turn) * Four{-1, 1, -1, 0});
    columns[1] = Four{0, 1, 0, 0} + (lanes<0, 0, 1>(twice) * lanes<1, 0, 2>(turn) * Four{1, -1, 1, 0} +
                                     lanes<2, 2, 0>(twice) * lanes<3, 2, 3>(turn) * Four{-1, -1, 1, 0});
    columns[2] = Four{0, 0, 1, 0} + (lanes<0, 1, 0>(twice) * lanes<2, 2, 0>(turn) * Four{1, 1, -1, 0} +
                                     lanes<1, 0, 1>(twice) * lanes<3, 3, 1>(turn) * Four{1, -1, -1, 0});
  }
  auto matrix() const {
    return Eigen::Map<const Matrix3, Eigen::Unaligned, Eigen::OuterStride<4>>(reinterpret_cast<const double*>(columns));
  }
};

/// Moments of inertia in the axes in which those of the link are these.
BUBBLESIM_INLINE MatrixLanes turned_inertia(const Matrix3& inertia, const MatrixLanes& axes) {
  MatrixLanes half;  // rows of the result, columns of the link
  for (int c = 0; c < 3; ++c) half.columns[c] = axes * Four{inertia(0, c), inertia(1, c), inertia(2, c), 0};
  MatrixLanes made;
  for (int c = 0; c < 3; ++c) {
    made.columns[c] = half * Four{axes.columns[0][c], axes.columns[1][c], axes.columns[2][c], 0};
  }
  return made;
}

/// A motion, with which a point at r moves with `linear` + `angular` x r; or a force, with its moment about the origin.
struct SpatialLanes {
  Four angular = {};
  Four linear = {};

  /// Adds a multiple.
  BUBBLESIM_INLINE void add(double factor, const SpatialLanes& other) {
    angular += factor * other.angular;
    linear += factor * other.linear;
  }
  BUBBLESIM_INLINE void add(const SpatialLanes& other) {
    angular += other.angular;
    linear += other.linear;
  }
  /// What a force does along a motion.
  BUBBLESIM_INLINE double along(const SpatialLanes& motion) const {
    const Four parts = angular * motion.angular + linear * motion.linear;
    return parts[0] + parts[1] + parts[2];
  }
  /// Of a motion: the velocity of a point.
  BUBBLESIM_INLINE Four at(const Four& point) const { return linear + cross(angular, point); }
};

}  // namespace bubblesim
