// SPDX-License-Identifier: BSD-3-Clause
// Velocities, bias forces, mass matrix and factors of a tree.
#include "physics/solver/tree.hpp"
#include "scene/unit_steiner.hpp"

namespace bubblesim {

void Tree::set_velocities(const Eigen::VectorXd& rates) {
  for (int i = 0; i < links(); ++i) {
    const Placed& placed = links_[index(i)];
    RigidMotion& velocity = bodies_[index(i)].velocity;
    velocity = parent_of(placed.link).velocity;
    for (int k = placed.first_dof; k < placed.first_dof + placed.dof_count; ++k) {
      velocity += columns_[index(k)] * rates[k];
    }
  }
}

/// What the motions of columns, which the parent or the world carries, add to a link's acceleration.
void Tree::accelerate(int number, const Eigen::VectorXd& rates) {
  const Placed& placed = links_[index(number)];
  const Body& parent = parent_of(placed.link);
  Body& body = bodies_[index(number)];
  body.acceleration = parent.acceleration;
  const int dof = placed.first_dof;
  if (placed.link.motion == TreeMotion::kFree) {
    // The centre of mass goes straight on.
    body.acceleration.slide = body.velocity.at(body.centre).cross(body.velocity.turn);
    return;
  }
  if (placed.link.motion == TreeMotion::kBall) {
    // The axes are the world's, through a point of the parent.
    body.acceleration.slide += parent.velocity.at(body.anchor).cross(rates.segment<3>(dof));
    return;
  }
  RigidMotion carrier = parent.velocity;
  for (int k = dof; k < dof + placed.dof_count; ++k) {
    const RigidMotion own = columns_[index(k)] * rates[k];
    body.acceleration.turn += carrier.turn.cross(own.turn);
    body.acceleration.slide += carrier.turn.cross(own.slide) + carrier.slide.cross(own.turn);
    carrier += own;
  }
}

void Tree::bias(const Eigen::VectorXd& rates, const std::vector<Wrench>& wrenches, Eigen::VectorXd& forces) {
  for (int i = 0; i < links(); ++i) {
    accelerate(i, rates);
    Body& body = bodies_[index(i)];
    const Wrench& wrench = wrenches[index(i)];
    const Vector3& spin = body.velocity.turn;
    const Vector3 pull = body.acceleration.at(body.centre) + spin.cross(body.velocity.at(body.centre));
    body.force = pull * links_[index(i)].link.mass - wrench.force;
    body.moment = body.inertia * body.acceleration.turn + spin.cross(body.inertia * spin) - wrench.torque;
    body.moment += body.centre.cross(body.force);
  }
  forces.resize(dofs());
  for (int i = links() - 1; i >= 0; --i) {
    const Placed& placed = links_[index(i)];
    const Body& body = bodies_[index(i)];
    for (int k = placed.first_dof; k < placed.first_dof + placed.dof_count; ++k) {
      forces[k] = columns_[index(k)].turn.dot(body.moment) + columns_[index(k)].slide.dot(body.force);
    }
    if (placed.link.parent < 0) continue;
    bodies_[index(placed.link.parent)].force += body.force;
    bodies_[index(placed.link.parent)].moment += body.moment;
  }
}

void Tree::project(int link, const Vector3& moment, const Vector3& force, double* forces) const {
  for (int last = last_dof(link); last >= 0;) {
    const int first = mass_matrix_.first_of_run(last);
    directions_.project(moment, force, first, last - first + 1, forces + first);
    last = before(first);
  }
}

void Tree::compute_mass() {
  mass_matrix_.set_zero();
  for (int i = 0; i < links(); ++i) {
    Body& body = bodies_[index(i)];
    const Vector3& c = body.centre;
    body.inertia = body.axes * links_[index(i)].link.inertia * body.axes.transpose();
    body.mass = links_[index(i)].link.mass;
    body.first = c * body.mass;
    body.second = body.inertia + body.mass * unit_steiner(c);
  }
  for (int i = links() - 1; i >= 0; --i) {
    const Placed& placed = links_[index(i)];
    const Body& body = bodies_[index(i)];
    for (int k = placed.first_dof; k < placed.first_dof + placed.dof_count; ++k) {
      const RigidMotion& column = columns_[index(k)];
      const Vector3 momentum = column.slide * body.mass + column.turn.cross(body.first);
      const Vector3 angular = body.second * column.turn + body.first.cross(column.slide);
      for (int last = k; last >= 0;) {
        const int first = mass_matrix_.first_of_run(last);
        directions_.project(angular, momentum, first, last - first + 1, &mass_matrix_.entry(k, first));
        last = before(first);
      }
    }
    if (placed.link.parent < 0) continue;
    Body& parent = bodies_[index(placed.link.parent)];
    parent.mass += body.mass;
    parent.first += body.first;
    parent.second += body.second;
  }
}

void Tree::factor(const Eigen::VectorXd& added) {
  compute_mass();
  for (int k = 0; k < dofs(); ++k) mass_matrix_.entry(k, k) += added[k];
  mass_matrix_.factor();
}

void Tree::push(double step, const std::vector<Wrench>& wrenches, const Eigen::VectorXd& forces) {
  const auto predict = [&](const Eigen::VectorXd& rates) {
    bias(rates, wrenches, bias_);
    change_ = (forces - bias_) * step;
    mass_matrix_.solve_upper(change_.data());
    for (int k = 0; k < dofs(); ++k) change_[k] *= mass_matrix_.inverse_diagonal(k);
    mass_matrix_.solve_lower(change_.data());
  };
  predict(rates_);
  middle_ = rates_ + change_ / 2;
  set_velocities(middle_);
  predict(middle_);
  rates_ += change_;
}

Vector3 Tree::acceleration(int link, const Vector3& point) const {
  const Body& body = bodies_[index(link)];
  const Vector3 from_origin = point - origin_;
  return body.acceleration.at(from_origin) + body.velocity.turn.cross(body.velocity.at(from_origin));
}

double Tree::kinetic_energy() const {
  double sum = 0;
  for (int i = 0; i < links(); ++i) {
    const Body& body = bodies_[index(i)];
    const Twist velocity = this->velocity(i);
    const Vector3 spin = body.axes.transpose() * velocity.angular;
    sum += links_[index(i)].link.mass * velocity.linear.squaredNorm() + spin.dot(links_[index(i)].link.inertia * spin);
  }
  return sum / 2;
}

}  // namespace bubblesim
