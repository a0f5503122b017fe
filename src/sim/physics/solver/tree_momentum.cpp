// SPDX-License-Identifier: BSD-3-Clause
// The momenta of floating trees. Coordinates keep them only as exactly as a substep is short: the mass matrix is that
// of the place before.
#include <Eigen/Cholesky>

#include "physics/solver/tree.hpp"
#include "scene/simd.hpp"
#include "scene/unit_steiner.hpp"

namespace bubblesim {

TreeMomentum Tree::momentum(int link, const Twist& velocity) const {
  const Body& body = bodies_[index(link)];
  const Four linear = lanes_of(velocity.linear) * body.mass;
  return {vector_of(linear), vector_of(cross(body.centre, linear) + body.inertia * lanes_of(velocity.angular))};
}

TreeMomentum Tree::momentum(int number) const {
  const TreeLink& link = links_[index(number)].link;
  const Body& body = bodies_[index(number)];
  const Four linear = body.velocity.at(body.centre) * link.mass;
  const Four angular = turned_inertia(link.inertia, body.axes) * body.velocity.angular;
  return {vector_of(linear), vector_of(cross(body.centre, linear) + angular)};
}

/// Changes the velocities of links that hang together as if they were one rigid body.
BUBBLESIM_SIMD void Tree::set_momentum(int root, const TreeMomentum& wanted) {
  Four linear = lanes_of(wanted.linear);  // that is missing
  Four angular = lanes_of(wanted.angular);
  double mass = 0;
  Four first = {};
  MatrixLanes second;
  for (Four& column : second.columns) column = Four{};
  for (int i = root; i < links(); ++i) {
    if (free_root(i) != root) continue;
    const TreeLink& link = links_[index(i)].link;
    const Body& body = bodies_[index(i)];
    const Four centre = body.centre;
    const MatrixLanes inertia = turned_inertia(link.inertia, body.axes);
    const Four push = body.velocity.at(centre) * link.mass;
    linear -= push;
    angular -= cross(centre, push) + inertia * body.velocity.angular;
    mass += link.mass;
    first += centre * link.mass;
    const Four square = centre * centre;
    for (int c = 0; c < 3; ++c) {
      second.columns[c] += inertia.columns[c] - centre * (centre[c] * link.mass);
      second.columns[c][c] += (square[0] + square[1] + square[2]) * link.mass;
    }
  }
  const Vector3 centre = vector_of(first) / mass;
  const Vector3 slide = vector_of(linear) / mass;
  const Matrix3 about_centre = second.matrix() - mass * unit_steiner(centre);
  const Vector3 turn = about_centre.ldlt().solve(vector_of(angular) - centre.cross(vector_of(linear)));
  const SpatialLanes change{lanes_of(turn), lanes_of(slide - turn.cross(centre))};
  for (int i = root; i < links(); ++i) {
    if (free_root(i) == root) bodies_[index(i)].velocity.add(change);
  }
}

void Tree::set_momenta(const std::vector<TreeMomentum>& wanted) {
  for (int root = 0; root < links(); ++root) {
    if (free_root(root) == root) set_momentum(root, wanted[index(root)]);
  }
}

}  // namespace bubblesim
