// SPDX-License-Identifier: BSD-3-Clause
// The momenta of floating trees. Coordinates keep them only as exactly as a substep is short: the mass matrix is that
// of the place before.
#include <Eigen/Cholesky>

#include "physics/solver/tree.hpp"
#include "scene/unit_steiner.hpp"

namespace bubblesim {

TreeMomentum Tree::momentum(int number) const {
  const TreeLink& link = links_[index(number)].link;
  const Body& body = bodies_[index(number)];
  const Vector3 linear = body.velocity.at(body.centre) * link.mass;
  return {linear,
          body.centre.cross(linear) + body.axes * (link.inertia * (body.axes.transpose() * body.velocity.turn))};
}

void Tree::set_momenta(const std::vector<TreeMomentum>& wanted) {
  for (int root = 0; root < links(); ++root) {
    if (free_root(root) != root) continue;
    TreeMomentum missing = wanted[index(root)];
    double mass = 0;
    Vector3 first;
    Matrix3 second = Matrix3::Zero();
    for (int i = root; i < links(); ++i) {
      if (free_root(i) != root) continue;
      const TreeLink& link = links_[index(i)].link;
      const Body& body = bodies_[index(i)];
      const Vector3& c = body.centre;
      const TreeMomentum present = momentum(i);
      missing.linear -= present.linear;
      missing.angular -= present.angular;
      mass += link.mass;
      first += c * link.mass;
      second += body.axes * link.inertia * body.axes.transpose() + link.mass * unit_steiner(c);
    }
    const Vector3 centre = first / mass;
    second -= mass * unit_steiner(centre);
    const Vector3 turn = second.ldlt().solve(missing.angular - centre.cross(missing.linear));
    const RigidMotion change{turn, missing.linear / mass - turn.cross(centre)};
    for (int i = root; i < links(); ++i) {
      if (free_root(i) == root) bodies_[index(i)].velocity += change;
    }
  }
}

}  // namespace bubblesim
