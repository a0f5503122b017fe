// SPDX-License-Identifier: BSD-3-Clause
// The momenta of floating trees. Coordinates keep them only as exactly as a substep is short: the mass matrix is that
// of the place before.
#include "physics/solver/tree.hpp"
#include "scene/simd.hpp"

namespace bubblesim {

BUBBLESIM_SIMD void Tree::release(const std::vector<TreeLinkState>& states, const std::vector<SpatialLanes>& wrenches,
                                  double step, std::vector<SpatialLanes>& momenta) const {
  for (int i = 0; i < links(); ++i) {
    const Body& body = bodies_[index(i)];
    const SpatialLanes& wrench = wrenches[index(i)];
    SpatialLanes& made = momenta[index(i)];
    made = body.momentum(states[index(i)].velocity.linear, states[index(i)].velocity.angular);
    made.add(step, {wrench.angular + cross(body.centre, wrench.linear), wrench.linear});
  }
}

namespace {

/// Solves for a vector by a symmetric positive definite matrix, whose factors are L D L^T.
BUBBLESIM_INLINE Four solve(const MatrixLanes& matrix, const Four& given) {
  const Four* const a = matrix.columns;
  const double d0 = 1 / a[0][0];
  const double l10 = a[0][1] * d0;
  const double l20 = a[0][2] * d0;
  const double d1 = 1 / (a[1][1] - l10 * a[0][1]);
  const double left = a[1][2] - l10 * a[0][2];
  const double l21 = left * d1;
  const double d2 = 1 / (a[2][2] - l20 * a[0][2] - l21 * left);
  const double y1 = given[1] - l10 * given[0];
  const double z = (given[2] - l20 * given[0] - l21 * y1) * d2;
  const double y = y1 * d1 - l21 * z;
  return Four{given[0] * d0 - l10 * y - l20 * z, y, z, 0};
}

}  // namespace

/// Changes the velocities of links that hang together as if they were one rigid body.
BUBBLESIM_SIMD void Tree::set_momentum(int root, const std::vector<SpatialLanes>& momenta) {
  SpatialLanes missing;
  double mass = 0;
  Four first = {};
  MatrixLanes second;
  for (Four& column : second.columns) column = Four{};
  const auto add_point = [&](const Four& place, double weight) {
    const double square = lanes_dot(place, place);
    const MatrixLanes unit;
    for (int c = 0; c < 3; ++c) second.columns[c] += (unit.columns[c] * square - place * place[c]) * weight;
  };
  for (int i = root; i < links(); ++i) {
    if (free_root(i) != root) continue;
    const Body& body = bodies_[index(i)];
    missing.add(momenta[index(i)]);
    missing.add(-1, momentum(i));
    mass += body.mass;
    first += body.centre * body.mass;
    for (int c = 0; c < 3; ++c) second.columns[c] += body.inertia.columns[c];
    add_point(body.centre, body.mass);
  }
  const Four centre = first * (1 / mass);
  const Four slide = missing.linear * (1 / mass);
  add_point(centre, -mass);
  SpatialLanes change;
  change.angular = solve(second, missing.angular - cross(centre, missing.linear));
  change.linear = slide - cross(change.angular, centre);
  for (int i = root; i < links(); ++i) {
    if (free_root(i) == root) bodies_[index(i)].velocity.add(change);
  }
}

void Tree::set_momenta(const std::vector<SpatialLanes>& momenta) {
  for (int root = 0; root < links(); ++root) {
    if (free_root(root) == root) set_momentum(root, momenta);
  }
}

}  // namespace bubblesim
