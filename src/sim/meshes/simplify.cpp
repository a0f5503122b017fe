// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/simplify.hpp"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace bubblesim {
namespace {

constexpr int kRounds = 8;
constexpr float kAnyError = 1;  // relative to the mesh's size
constexpr std::size_t kCoordinates = 3 * sizeof(float);

}  // namespace

std::size_t most_in_cubic_metre(const std::vector<float>& coordinates, const CornerIndices& triangles) {
  std::map<std::array<int, 3>, std::size_t> cells;
  std::size_t most = 0;
  for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
    std::array<int, 3> cell{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      float sum = 0;
      for (std::size_t corner = 0; corner < 3; ++corner)
        sum += coordinates[3 * std::size_t{triangles[i + corner]} + axis];
      cell[axis] = static_cast<int>(std::floor(sum / 3));
    }
    most = std::max(most, ++cells[cell]);
  }
  return most;
}

double simplify(const std::vector<float>& coordinates, CornerIndices& triangles, std::size_t most) {
  const std::size_t corners = coordinates.size() / 3;
  double moved = 0;
  for (int round = 0; round < kRounds; ++round) {
    const std::size_t fullest = most_in_cubic_metre(coordinates, triangles);
    if (fullest <= most) break;
    const auto part = static_cast<double>(most) / static_cast<double>(fullest);
    const std::size_t before = triangles.size() / 3;
    const std::size_t target = 3 * static_cast<std::size_t>(part * static_cast<double>(before));
    CornerIndices fewer(triangles.size());
    float error = 0;
    std::size_t left = meshopt_simplify(fewer.data(), triangles.data(), triangles.size(), coordinates.data(), corners,
                                        kCoordinates, target, kAnyError, 0, &error);
    if (left > (target + triangles.size()) / 2) {  // it keeps holes and separate parts, of which there may be too many
      left = meshopt_simplifySloppy(fewer.data(), triangles.data(), triangles.size(), coordinates.data(), corners,
                                    kCoordinates, target, kAnyError, &error);
    }
    if (left == 0 || left >= triangles.size()) break;
    fewer.resize(left);
    triangles = std::move(fewer);
    moved += static_cast<double>(error) *
             static_cast<double>(meshopt_simplifyScale(coordinates.data(), corners, kCoordinates));
  }
  return moved;
}

}  // namespace bubblesim
