// SPDX-License-Identifier: BSD-3-Clause
// The directions in which degrees of freedom move.
#pragma once

#include <array>
#include <vector>

#include "bubblesim/math.hpp"
#include "physics/solver/spatial_lanes.hpp"

namespace bubblesim {

/// By components, for loops over many of them.
class Directions {
 public:
  void add();
  void set(int dof, const SpatialLanes& direction);
  /// Adds what a force, and its moment about the origin, do along degrees of freedom with consecutive numbers.
  void project(const SpatialLanes& force, int first, int count, double* to) const;

 private:
  std::array<std::vector<double>, 6> components_;  // of `turn`, then of `slide`, by degree of freedom
};

}  // namespace bubblesim
