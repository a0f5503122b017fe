// SPDX-License-Identifier: BSD-3-Clause
// Pose of a moving link in the world; the rotation as a matrix, which is faster for many points.
#pragma once

#include <array>

#include "bubblesim/math.hpp"

namespace bubblesim::rays {

struct LinkFrame {
  Matrix3 turn = Matrix3::Identity();
  Vector3 position;
};

/// For Embree: column-major, 3 rows and 4 columns.
inline std::array<float, 12> to_matrix(const LinkFrame& frame) {
  std::array<float, 12> matrix;
  Eigen::Map<Eigen::Matrix3f>(matrix.data()) = frame.turn.cast<float>();
  Eigen::Map<Eigen::Vector3f>(matrix.data() + 9) = frame.position.cast<float>();
  return matrix;
}

}  // namespace bubblesim::rays
