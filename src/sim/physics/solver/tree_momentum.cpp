// SPDX-License-Identifier: BSD-3-Clause
// The momenta of floating trees. Coordinates keep them only as exactly as a substep is short: the mass matrix is that
// of the place before.
#include <Eigen/Cholesky>

#include "physics/solver/tree.hpp"

namespace bubblesim {

void Tree::find_momenta(std::vector<TreeMomentum>& found) const {
  found.assign(links_.size(), {});
  for (int i = 0; i < links(); ++i) {
    if (free_root(i) < 0) continue;
    const TreeLink& link = links_[index(i)].link;
    const Body& body = bodies_[index(i)];
    TreeMomentum& sum = found[index(free_root(i))];
    const Vector3 linear = body.velocity * link.mass;
    sum.linear += linear;
    sum.angular += body.centre.cross(linear) + body.axes * (link.inertia * (body.axes.transpose() * body.spin));
  }
}

void Tree::set_momenta(const std::vector<TreeMomentum>& wanted) {
  find_momenta(present_);
  for (int root = 0; root < links(); ++root) {
    if (free_root(root) != root) continue;
    double mass = 0;
    Vector3 first;
    Matrix3 second = Matrix3::Zero();
    for (int i = root; i < links(); ++i) {
      if (free_root(i) != root) continue;
      const TreeLink& link = links_[index(i)].link;
      const Body& body = bodies_[index(i)];
      const Vector3& c = body.centre;
      mass += link.mass;
      first += c * link.mass;
      second += body.axes * link.inertia * body.axes.transpose() +
                link.mass * (c.squaredNorm() * Matrix3::Identity() - c * c.transpose());
    }
    const Vector3 centre = first / mass;
    second -= mass * (centre.squaredNorm() * Matrix3::Identity() - centre * centre.transpose());
    const Vector3 linear = wanted[index(root)].linear - present_[index(root)].linear;
    const Vector3 angular = wanted[index(root)].angular - present_[index(root)].angular - centre.cross(linear);
    const Vector3 turn = second.ldlt().solve(angular);
    for (int i = root; i < links(); ++i) {
      if (free_root(i) != root) continue;
      Body& body = bodies_[index(i)];
      body.velocity += linear / mass + turn.cross(body.centre - centre);
      body.spin += turn;
    }
  }
}

}  // namespace bubblesim
