// SPDX-License-Identifier: BSD-3-Clause
// Pose of a moving link in the world; the rotation as a matrix, which is faster for many points.
#pragma once

#include <array>
#include <cstddef>
#include <ignition/math/Matrix3.hh>

#include "bubblesim/math.hpp"

namespace bubblesim::rays {

struct LinkFrame {
  ignition::math::Matrix3d turn;
  Vector3 position;
};

/// For Embree: column-major, 3 rows and 4 columns.
inline std::array<float, 12> to_matrix(const LinkFrame& frame) {
  std::array<float, 12> matrix;
  for (std::size_t column = 0; column < 3; ++column) {
    for (std::size_t row = 0; row < 3; ++row) matrix[3 * column + row] = static_cast<float>(frame.turn(row, column));
  }
  for (std::size_t row = 0; row < 3; ++row) matrix[9 + row] = static_cast<float>(frame.position[row]);
  return matrix;
}

}  // namespace bubblesim::rays
