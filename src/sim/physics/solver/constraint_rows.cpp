// SPDX-License-Identifier: BSD-3-Clause
#include "physics/solver/constraint_rows.hpp"

#include <algorithm>

#include "physics/ode/constraint_defaults.hpp"

namespace bubblesim {
namespace {

constexpr double kImmovable = 1e-14;  // of the largest diagonal element
// Parts of a diagonal element that are added to it where rows repeat each other:
constexpr double kOfAnyRow = 1e-9;
constexpr double kOfContacts = 1e-6;  // the contacts of a box hold it in twice as many ways as it moves

std::size_t at(int number) { return static_cast<std::size_t>(number); }

}  // namespace

void ConstraintRows::clear() {
  rows_.clear();
  actions_.clear();
  used_ = 0;
  impacts_.clear();
  problem_.blocks.clear();
}

double* ConstraintRows::values(Tree& tree) {
  std::size_t found = used_;
  while (found > 0 && trees_[found - 1].tree != &tree) --found;
  if (found == 0) {
    if (used_ == trees_.size()) trees_.emplace_back();
    RowsOfTree& fresh = trees_[used_++];
    fresh.tree = &tree;
    fresh.rows.clear();
    fresh.given.clear();
    tree.factor();
    found = used_;
  }
  RowsOfTree& own = trees_[found - 1];
  if (own.rows.empty() || own.rows.back() != count() - 1) {
    own.rows.push_back(count() - 1);
    own.given.resize(own.given.size() + at(tree.dofs()), 0);
  }
  return own.given.data() + own.given.size() - at(tree.dofs());
}

void ConstraintRows::add_way(const TreeBody& body, const Vector3& turn, const Vector3& push, const Vector3& point,
                             double sign) {
  if (body.tree == nullptr) return;
  double* own = values(*body.tree);
  const Vector3 moment = sign * (turn + (point - body.tree->origin()).cross(push));
  const Vector3 force = sign * push;
  body.tree->project(body.link, moment, force, own);
}

void ConstraintRows::act(const TreeBody& first, const TreeBody& second, const Vector3& turn, const Vector3& push,
                         const Vector3& point) {
  actions_.push_back({count() - 1, first, second, turn, push, point});
  add_way(first, turn, push, point, 1);
  add_way(second, turn, push, point, -1);
}

int ConstraintRows::add_force(const TreeBody& first, const TreeBody& second, const Vector3& point,
                              const Vector3& direction) {
  rows_.emplace_back().singular = kOfAnyRow;
  act(first, second, Vector3(), direction, point);
  return count() - 1;
}

int ConstraintRows::add_torque(const TreeBody& first, const TreeBody& second, const Vector3& axis) {
  rows_.emplace_back().singular = kOfAnyRow;
  act(first, second, axis, Vector3(), Vector3());
  return count() - 1;
}

void ConstraintRows::add_torque_to_last(const TreeBody& first, const TreeBody& second, const Vector3& axis) {
  act(first, second, axis, Vector3(), Vector3());
}

int ConstraintRows::add_dof(Tree& tree, int dof) {
  rows_.emplace_back().singular = kOfAnyRow;
  values(tree)[dof] = 1;
  return count() - 1;
}

void ConstraintRows::set_of_contact(int row) { rows_[at(row)].singular = kOfContacts; }

void ConstraintRows::hold(int row, double error, double step, double drift) {
  set(row, -(kErrorReduction * error + drift) / step, kConstraintSoftness / step, 0);
  ConeBlock block;
  block.row = row;
  bound(block);
}

void ConstraintRows::set(int row, double target, double softness, double start) {
  rows_[at(row)].target = target;
  rows_[at(row)].softness = softness;
  rows_[at(row)].start = start;
}

/// Adds the part of a tree to the problem.
void ConstraintRows::gather(RowsOfTree& own) {
  const int rows = static_cast<int>(own.rows.size());
  const int dofs = own.tree->dofs();
  own.solved.set_zero(rows, dofs);
  for (int r = 0; r < rows; ++r) {
    const double* given = own.given.data() + at(r) * at(dofs);
    double velocity = 0;
    for (int k = 0; k < dofs; ++k) {
      own.solved[k][r] = given[k];
      velocity += given[k] * own.tree->rates()[k];
    }
    problem_.b[own.rows[at(r)]] -= velocity;
  }
  const BranchedFactors& mass = own.tree->factors();
  mass.solve_upper(own.solved);
  square_.set_weighted_square(own.solved, mass.inverse_diagonals());
  for (int c = 0; c < rows; ++c) {
    const double* column = square_[c];
    for (int r = c; r < rows; ++r) problem_.a(own.rows[at(r)], own.rows[at(c)]) += column[r];
  }
}

/// u += L^-1 D^-1 L^-T J^T x
void ConstraintRows::apply(const RowsOfTree& own) {
  const BranchedFactors& mass = own.tree->factors();
  change_.resize(own.tree->dofs());
  for (int k = 0; k < own.tree->dofs(); ++k) {
    double sum = 0;
    for (int r = 0; r < own.solved.rows(); ++r) sum += own.solved[k][r] * problem_.x[own.rows[at(r)]];
    change_[k] = sum * mass.inverse_diagonal(k);
  }
  mass.solve_lower(change_.data());
  own.tree->rates() += change_;
}

void ConstraintRows::add_impulses(const Tree& tree, std::vector<TreeMomentum>& links) const {
  for (const Action& action : actions_) {
    const auto add = [&](const TreeBody& body, double impulse) {
      if (body.tree != &tree) return;
      TreeMomentum& link = links[at(body.link)];
      link.linear += action.push * impulse;
      link.angular += (action.turn + (action.point - tree.origin()).cross(action.push)) * impulse;
    };
    add(action.first, problem_.x[action.row]);
    add(action.second, -problem_.x[action.row]);
  }
}

/// Leaves a row out along which nothing can move, such as that of a contact of a fixed link.
void ConstraintRows::leave_out(int row) {
  problem_.a.row(row).setZero();
  problem_.a.col(row).setZero();
  problem_.a(row, row) = 1;
  problem_.b[row] = problem_.x[row] = 0;
}

void ConstraintRows::pass_impacts_on() {
  if (!impacts_.run([&](int a, int b) { return problem_.a(a, b); })) return;
  for (const Impact& impact : impacts_.impacts()) {
    if (impact.impulse == 0) continue;
    problem_.b[impact.contact] += impact.target() - rows_[at(impact.contact)].target;
    problem_.x[impact.contact] += impact.impulse;
  }
}

ConeResult ConstraintRows::solve() {
  const int n = count();
  if (n == 0) return {};
  problem_.a.setZero(n, n);
  problem_.b.resize(n);
  problem_.x.resize(n);
  for (int r = 0; r < n; ++r) {
    problem_.b[r] = rows_[at(r)].target;
    problem_.x[r] = rows_[at(r)].start;
  }
  for (std::size_t i = 0; i < used_; ++i) gather(trees_[i]);
  const double largest = problem_.a.diagonal().maxCoeff();
  for (int c = 0; c < n; ++c) {
    if (problem_.a(c, c) <= kImmovable * largest) leave_out(c);
    problem_.a(c, c) += std::max(rows_[at(c)].softness, rows_[at(c)].singular * problem_.a(c, c));
    for (int r = c + 1; r < n; ++r) problem_.a(c, r) = problem_.a(r, c);
  }
  pass_impacts_on();
  const ConeResult result = solver_.solve(problem_);
  for (std::size_t i = 0; i < used_; ++i) apply(trees_[i]);
  return result;
}

}  // namespace bubblesim
