// SPDX-License-Identifier: BSD-3-Clause
// Velocities, bias forces, mass matrix and factors of a tree.
#include "physics/solver/tree.hpp"
#include "scene/unit_steiner.hpp"

namespace bubblesim {
namespace {

using Values = Eigen::Map<Eigen::VectorXd>;
using Constants = Eigen::Map<const Eigen::VectorXd>;

}  // namespace

void Tree::set_velocities(const Eigen::VectorXd& rates) {
  for (int i = 0; i < links(); ++i) {
    const Placed& placed = links_[index(i)];
    Body& body = bodies_[index(i)];
    body.spin = body.velocity = Vector3();
    if (placed.link.parent >= 0) {
      const Body& parent = bodies_[index(placed.link.parent)];
      body.spin = parent.spin;
      body.velocity = parent.velocity + parent.spin.cross(body.centre - parent.centre);
    }
    for (int k = placed.first_dof; k < placed.first_dof + placed.dof_count; ++k) {
      const TreeColumn& column = columns_[index(k)];
      body.spin += column.turn * rates[k];
      body.velocity += (column.slide + column.turn.cross(body.centre)) * rates[k];
    }
  }
}

/// The acceleration of a link's centre of mass while the rates are constant; velocities are set.
void Tree::accelerate(int number, const Eigen::VectorXd& rates) {
  const Placed& placed = links_[index(number)];
  const TreeLink& link = placed.link;
  Body& body = bodies_[index(number)];
  const Body& parent = parent_of(link);
  if (link.motion == TreeMotion::kFree) {
    body.turn = body.pull = Vector3();
    return;
  }
  body.turn = parent.turn;
  const Vector3 arm = body.anchor - parent.centre;
  Vector3 at_anchor = parent.pull + parent.turn.cross(arm) + parent.spin.cross(parent.spin.cross(arm));
  const int dof = placed.first_dof;
  if (link.motion == TreeMotion::kTurns || link.motion == TreeMotion::kScrews || link.motion == TreeMotion::kTwoAxes) {
    const Vector3 own = columns_[index(dof)].turn * rates[dof];
    body.turn += parent.spin.cross(own);
    at_anchor += parent.spin.cross(own) * (2 * link.lead);
    if (link.motion == TreeMotion::kTwoAxes) {
      const Vector3 second = columns_[index(dof + 1)].turn * rates[dof + 1];
      body.turn += (parent.spin + own).cross(second);
    }
  }
  if (link.motion == TreeMotion::kSlides) at_anchor += parent.spin.cross(columns_[index(dof)].slide) * (2 * rates[dof]);
  const Vector3 lever = body.centre - body.anchor;
  body.pull = at_anchor + body.turn.cross(lever) + body.spin.cross(body.spin.cross(lever));
}

void Tree::bias(const Eigen::VectorXd& rates, const std::vector<Wrench>& wrenches, Eigen::VectorXd& forces) {
  for (int i = 0; i < links(); ++i) {
    accelerate(i, rates);
    Body& body = bodies_[index(i)];
    const Wrench& wrench = wrenches[index(i)];
    body.force = body.pull * links_[index(i)].link.mass - wrench.force;
    body.moment = body.inertia * body.turn + body.spin.cross(body.inertia * body.spin) - wrench.torque;
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

void Tree::compute_mass() {
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
      const TreeColumn& column = columns_[index(k)];
      const Vector3 momentum = column.slide * body.mass + column.turn.cross(body.first);
      const Vector3 angular = body.second * column.turn + body.first.cross(column.slide);
      for (int j = k; j >= 0; j = before_[index(j)]) {
        entry(k, j) = columns_[index(j)].turn.dot(angular) + columns_[index(j)].slide.dot(momentum);
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
  for (int k = dofs() - 1; k >= 0; --k) entry(k, k) += added[k];
  for (int k = dofs() - 1; k >= 0; --k) {
    double* own = &matrix_[row_[index(k)]];
    const double inverse = inverse_diagonal_[index(k)] = 1 / own[depth_[index(k)]];
    for (int i = before_[index(k)]; i >= 0; i = before_[index(i)]) {
      const double part = own[depth_[index(i)]] * inverse;
      const auto count = static_cast<Eigen::Index>(depth_[index(i)] + 1);
      Values(&matrix_[row_[index(i)]], count) -= part * Values(own, count);
      own[depth_[index(i)]] = part;
    }
  }
}

void Tree::solve_upper(double* y) const {
  for (int k = dofs() - 1; k >= 0; --k) {
    const double* own = &matrix_[row_[index(k)]];
    for (int last = before_[index(k)]; last >= 0; last = before_[index(run_[index(last)])]) {
      const int first = run_[index(last)];
      Values(y + first, last - first + 1) -= y[k] * Constants(own + depth_[index(first)], last - first + 1);
    }
  }
}

void Tree::solve_upper(Columns& y) const {
  for (int k = dofs() - 1; k >= 0; --k) {
    const double* own = &matrix_[row_[index(k)]];
    for (int i = before_[index(k)]; i >= 0; i = before_[index(i)]) y.add(y[i], -own[depth_[index(i)]], y[k]);
  }
}

void Tree::solve_lower(double* y) const {
  for (int k = 0; k < dofs(); ++k) {
    const double* own = &matrix_[row_[index(k)]];
    for (int last = before_[index(k)]; last >= 0; last = before_[index(run_[index(last)])]) {
      const int first = run_[index(last)];
      y[k] -= Constants(y + first, last - first + 1).dot(Constants(own + depth_[index(first)], last - first + 1));
    }
  }
}

void Tree::push(double step, const std::vector<Wrench>& wrenches, const Eigen::VectorXd& forces) {
  const auto predict = [&](const Eigen::VectorXd& rates) {
    bias(rates, wrenches, bias_);
    change_ = (forces - bias_) * step;
    solve_upper(change_.data());
    for (int k = 0; k < dofs(); ++k) change_[k] *= inverse_diagonal_[index(k)];
    solve_lower(change_.data());
  };
  predict(rates_);
  middle_ = rates_ + change_ / 2;
  set_velocities(middle_);
  predict(middle_);
  rates_ += change_;
}

double Tree::kinetic_energy() const {
  double sum = 0;
  for (int i = 0; i < links(); ++i) {
    const Body& body = bodies_[index(i)];
    const Vector3 spin = body.axes.transpose() * body.spin;
    sum += links_[index(i)].link.mass * body.velocity.squaredNorm() + spin.dot(links_[index(i)].link.inertia * spin);
  }
  return sum / 2;
}

}  // namespace bubblesim
