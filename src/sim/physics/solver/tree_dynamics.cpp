// SPDX-License-Identifier: BSD-3-Clause
// Velocities, inertias and accelerations of a tree.
#include <algorithm>

#include "physics/solver/tree.hpp"
#include "scene/simd.hpp"

namespace bubblesim {

BUBBLESIM_SIMD void Tree::set_velocities(const Eigen::VectorXd& rates) {
  for (int i = 0; i < links(); ++i) set_velocity(i, rates.data());
}

/// That of the parent is set.
BUBBLESIM_INLINE void Tree::set_velocity(int link, const double* rates) {
  const LinkDofs& own = numbers_[index(link)];
  if (own.is_base) {
    bodies_[0].velocity.angular = Four{rates[0], rates[1], rates[2], 0};
    bodies_[0].velocity.linear = Four{rates[3], rates[4], rates[5], 0};
    return;
  }
  SpatialLanes velocity = parent_of(own).velocity;
  for (int k = own.first; k < own.first + own.count; ++k) velocity.add(rates[k], dofs_[index(k)].direction);
  bodies_[index(link)].velocity = velocity;
}

BUBBLESIM_SIMD void Tree::weigh(const Eigen::VectorXd& added) {
  for (int i = 0; i < links(); ++i) {
    const Body& body = bodies_[index(i)];
    // A point mass at r resists a turn about the axis e by r x (e x r), and by e x r.
    const Four r = body.centre;
    for (int j = 0; j < 3; ++j) {
      const Four axis{j == 0 ? 1.0 : 0.0, j == 1 ? 1.0 : 0.0, j == 2 ? 1.0 : 0.0, 0};
      const Four push = cross(axis, r) * body.mass;
      inertias_[index(i)].columns[j].angular = body.inertia.columns[j] + cross(r, push);
      inertias_[index(i)].columns[j].linear = push;
      inertias_[index(i)].columns[j + 3].angular = -push;
      inertias_[index(i)].columns[j + 3].linear = axis * body.mass;
    }
  }
  eliminate(numbers_.data(), links(), added.data(), inertias_.data(), dofs_.data());
}

BUBBLESIM_SIMD void Tree::add_impulses(const std::vector<TreeLinkState>& states, double step,
                                       std::vector<SpatialLanes>& wrenches) const {
  for (int i = 0; i < links(); ++i) {
    const Body& body = bodies_[index(i)];
    const SpatialLanes& given = states[index(i)].velocity;
    const Four force = (given.linear - body.velocity.at(body.centre)) * (body.mass / step);
    const Four torque = body.inertia * (given.angular - body.velocity.angular) * (1 / step);
    wrenches[index(i)].add({torque, force});
  }
}

BUBBLESIM_SIMD void Tree::factor() {
  for (int k = 0; k < dofs(); ++k) {
    const TreeDof& dof = dofs_[index(k)];
    if (has_long_runs_) directions_.set(k, dof.direction);
    factors_.set_inverse_diagonal(k, dof.inverse_inertia);
  }
  factors_.set_zero();
  for (int k = 0; k < dofs(); ++k) {
    const TreeDof& dof = dofs_[index(k)];
    for (int last = before(k); last >= 0;) {
      const int first = factors_.first_of_run(last);
      project(dof.passes, first, last - first + 1, &factors_.entry(k, first));
      last = before(first);
    }
  }
}

BUBBLESIM_SIMD void Tree::project(int link, const Vector3& point, double sign, SpatialLanes* forces, int count,
                                  double* rows, std::size_t width) const {
  const Four from_origin = lanes_of(point) - lanes_of(origin_);
  for (int i = 0; i < count; ++i) {
    const Four linear = forces[i].linear * sign;
    forces[i] = {forces[i].angular * sign + cross(from_origin, linear), linear};
  }
  for (int last = last_dof(link); last >= 0;) {
    const int first = factors_.first_of_run(last);
    for (int i = 0; i < count; ++i) project(forces[i], first, last - first + 1, rows + index(i) * width + first);
    last = before(first);
  }
}

/// Adds what a force does along degrees of freedom with consecutive numbers.
BUBBLESIM_INLINE void Tree::project(const SpatialLanes& force, int first, int count, double* along) const {
  int done = 0;
  if (first == 0 && numbers_[0].is_base) {
    done = std::min(count, 6);
    for (int k = 0; k < done; ++k) along[k] += k < 3 ? force.angular[k] : force.linear[k - 3];
  }
  if (count - done > kShortRun) return directions_.project(force, first + done, count - done, along + done);
  for (; done < count; ++done) along[done] += force.along(dofs_[index(first + done)].direction);
}

/// Computes the acceleration of a link while the rates are constant; that of the parent is there.
BUBBLESIM_INLINE void Tree::accelerate(int link, const double* rates) {
  const LinkDofs& own = numbers_[index(link)];
  const Body& parent = parent_of(own);
  Body& body = bodies_[index(link)];
  SpatialLanes acceleration = parent.acceleration;
  if (own.is_free) {
    // The centre of mass goes straight on.
    acceleration.linear = cross(body.velocity.at(body.centre), body.velocity.angular);
  } else if (own.is_ball) {
    // The axes are the world's, through a point of the parent.
    const Four spin{rates[own.first], rates[own.first + 1], rates[own.first + 2], 0};
    acceleration.linear += cross(parent.velocity.at(body.anchor), spin);
  } else {
    // Parent or world carry the directions of motion.
    SpatialLanes carrier = parent.velocity;
    for (int k = own.first; k < own.first + own.count; ++k) {
      SpatialLanes motion;
      motion.add(rates[k], dofs_[index(k)].direction);
      acceleration.angular += cross(carrier.angular, motion.angular);
      acceleration.linear += cross(carrier.angular, motion.linear) + cross(carrier.linear, motion.angular);
      carrier.add(motion);
    }
  }
  body.acceleration = acceleration;
}

/// Computes what a link needs beside the wrench on it while the rates are constant.
BUBBLESIM_INLINE void Tree::find_need(int link, const double* rates, const SpatialLanes& wrench) {
  accelerate(link, rates);
  Body& body = bodies_[index(link)];
  const Four spin = body.velocity.angular;
  const Four pull = body.acceleration.at(body.centre) + cross(spin, body.velocity.at(body.centre));
  body.needs.linear = pull * body.mass - wrench.linear;
  body.needs.angular = body.inertia * body.acceleration.angular + cross(spin, body.inertia * spin) - wrench.angular +
                       cross(body.centre, body.needs.linear);
}

/// Passes the needs on to the parents, as far as the joints do not give way to the forces that are left.
BUBBLESIM_INLINE void Tree::gather_needs(const double* forces) {
  for (int i = links() - 1; i >= 0; --i) {
    const LinkDofs& own = numbers_[index(i)];
    if (own.is_base) {
      bodies_[index(i)].needs.angular -= Four{forces[0], forces[1], forces[2], 0};
      bodies_[index(i)].needs.linear -= Four{forces[3], forces[4], forces[5], 0};
      return;
    }
    SpatialLanes needs = bodies_[index(i)].needs;
    for (int k = own.first + own.count - 1; k >= own.first; --k) {
      const TreeDof& dof = dofs_[index(k)];
      change_[k] = forces[k] - needs.along(dof.direction);
      needs.add(change_[k], dof.passes);
    }
    if (own.parent >= 0) bodies_[index(own.parent)].needs.add(needs);
  }
}

/// By all that is left at once: the base has the inverse of its inertia.
BUBBLESIM_INLINE void Tree::find_change_of_base() {
  const SpatialLanes* const columns = inertias_[0].columns;
  const SpatialLanes& needs = bodies_[0].needs;
  SpatialLanes by_moment;
  SpatialLanes by_force;
  for (int j = 0; j < 3; ++j) {
    by_moment.add(needs.angular[j], columns[j]);
    by_force.add(needs.linear[j], columns[j + 3]);
  }
  by_moment.add(by_force);
  bodies_[0].change = by_moment;
  for (int k = 0; k < 3; ++k) {
    change_[k] = by_moment.angular[k];
    change_[k + 3] = by_moment.linear[k];
  }
}

/// Computes how a link's rates, and with them its velocity, change per second; that of the parent is there.
BUBBLESIM_INLINE void Tree::find_change(int link) {
  const LinkDofs& own = numbers_[index(link)];
  if (own.is_base) return find_change_of_base();
  SpatialLanes change = parent_of(own).change;
  for (int k = own.first; k < own.first + own.count; ++k) {
    const TreeDof& dof = dofs_[index(k)];
    change_[k] = change_[k] * dof.inverse_inertia - dof.passes.along(change);
    change.add(change_[k], dof.direction);
  }
  bodies_[index(link)].change = change;
}

BUBBLESIM_SIMD void Tree::push(double step, const std::vector<SpatialLanes>& wrenches, const Eigen::VectorXd& forces) {
  change_.resize(dofs());
  for (int i = 0; i < links(); ++i) find_need(i, rates_.data(), wrenches[index(i)]);
  gather_needs(forces.data());
  middle_.resize(dofs());
  for (int i = 0; i < links(); ++i) {
    find_change(i);
    const LinkDofs& own = numbers_[index(i)];
    for (int k = own.first; k < own.first + own.count; ++k) middle_[k] = rates_[k] + change_[k] * (step / 2);
    set_velocity(i, middle_.data());
    find_need(i, middle_.data(), wrenches[index(i)]);
  }
  gather_needs(forces.data());
  for (int i = 0; i < links(); ++i) find_change(i);
  for (int k = 0; k < dofs(); ++k) rates_[k] += change_[k] * step;
}

Vector3 Tree::acceleration(int link, const Vector3& point) const {
  const Body& body = bodies_[index(link)];
  const Four from_origin = lanes_of(point - origin_);
  return vector_of(body.acceleration.at(from_origin) + cross(body.velocity.angular, body.velocity.at(from_origin)));
}

double Tree::kinetic_energy() const {
  double sum = 0;
  for (int i = 0; i < links(); ++i) {
    const Twist velocity = this->velocity(i);
    const Vector3 spin = quaternion_of(bodies_[index(i)]).conjugate() * velocity.angular;
    sum += links_[index(i)].link.mass * velocity.linear.squaredNorm() + spin.dot(links_[index(i)].link.inertia * spin);
  }
  return sum / 2;
}

}  // namespace bubblesim
