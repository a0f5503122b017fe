// SPDX-License-Identifier: BSD-3-Clause
// Comparisons of vectors, rotations and poses.
#pragma once

#include <gtest/gtest.h>

#include "bubblesim/math.hpp"

namespace bubblesim::test {

inline void expect_near(const Vector3& found, const Vector3& wanted, double tolerance) {
  EXPECT_LE((found - wanted).norm(), tolerance) << found.transpose() << " instead of " << wanted.transpose();
}

/// The tolerance is an angle in rad.
inline void expect_near(const Quaternion& found, const Quaternion& wanted, double tolerance) {
  EXPECT_LE(found.angularDistance(wanted), tolerance)
      << "x, y, z, w: " << found.coeffs().transpose() << " instead of " << wanted.coeffs().transpose();
}

/// In m and in rad.
inline void expect_near(const Pose& found, const Pose& wanted, double tolerance) {
  expect_near(found.position, wanted.position, tolerance);
  expect_near(found.orientation, wanted.orientation, tolerance);
}

}  // namespace bubblesim::test
