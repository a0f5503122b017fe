// SPDX-License-Identifier: BSD-3-Clause
#include "physics/solver/directions.hpp"

#include "scene/simd.hpp"

namespace bubblesim {

void Directions::add() {
  for (std::vector<double>& component : components_) component.push_back(0);
}

void Directions::set(int dof, const SpatialLanes& direction) {
  const auto at = static_cast<std::size_t>(dof);
  for (std::size_t i = 0; i < 3; ++i) {
    components_[i][at] = direction.angular[i];
    components_[i + 3][at] = direction.linear[i];
  }
}

BUBBLESIM_SIMD void Directions::project(const SpatialLanes& force, int first, int count,
                                        double* __restrict__ to) const {
  const double* from[6];
  for (std::size_t i = 0; i < 6; ++i) from[i] = components_[i].data() + first;
  const Four& turn = force.angular;
  const Four& push = force.linear;
  for (int i = 0; i < count; ++i) {
    to[i] += (from[0][i] * turn[0] + from[1][i] * turn[1] + from[2][i] * turn[2]) +
             (from[3][i] * push[0] + from[4][i] * push[1] + from[5][i] * push[2]);
  }
}

}  // namespace bubblesim
