// SPDX-License-Identifier: BSD-3-Clause
#include "physics/solver/constraint_rows.hpp"

#include <algorithm>
#include <limits>

#include "physics/ode/constraint_defaults.hpp"
#include "scene/simd.hpp"

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

ConstraintRows::RowsOfTree& ConstraintRows::rows_of(Tree& tree) {
  for (std::size_t i = used_; i > 0; --i) {
    if (trees_[i - 1].tree == &tree) return trees_[i - 1];
  }
  if (used_ == trees_.size()) trees_.emplace_back();
  RowsOfTree& fresh = trees_[used_++];
  fresh.tree = &tree;
  fresh.width = Columns::in_groups(at(tree.dofs()));
  fresh.rows.clear();
  tree.factor();
  return fresh;
}

double* ConstraintRows::values(RowsOfTree& own, int rows) const {
  if (own.rows.empty() || own.rows.back() != count() - 1) {
    for (int row = count() - rows; row < count(); ++row) own.rows.push_back(row);
    const std::size_t end = own.rows.size() * own.width;
    if (own.given.size() < end) own.given.resize(2 * end);
    std::fill_n(own.given.data() + end - at(rows) * own.width, at(rows) * own.width, 0.0);
  }
  return own.given.data() + (own.rows.size() - at(rows)) * own.width;
}

void ConstraintRows::act(const TreeBody& body, const Vector3& point, double sign, const SpatialLanes* forces,
                         int count) {
  if (body.tree == nullptr) return;
  RowsOfTree& own = rows_of(*body.tree);
  Action& action = actions_.emplace_back();
  action.tree = body.tree;
  action.link = body.link;
  action.row = this->count() - count;
  action.count = count;
  std::copy_n(forces, count, action.forces.begin());
  body.tree->project(body.link, point, sign, action.forces.data(), count, values(own, count), own.width);
}

void ConstraintRows::act(const TreeBody& first, const TreeBody& second, const Vector3& point,
                         const SpatialLanes* forces, int count) {
  act(first, point, 1, forces, count);
  act(second, point, -1, forces, count);
}

int ConstraintRows::add_rows(int count) {
  const int first = this->count();
  for (int i = 0; i < count; ++i) rows_.emplace_back().singular = kOfAnyRow;
  return first;
}

int ConstraintRows::add_forces(const TreeBody& first, const TreeBody& second, const Vector3& point,
                               const SpatialLanes* forces, int count) {
  const int row = add_rows(count);
  act(first, second, point, forces, count);
  return row;
}

int ConstraintRows::add_force(const TreeBody& first, const TreeBody& second, const Vector3& point,
                              const Vector3& direction) {
  const SpatialLanes force{Four{}, lanes_of(direction)};
  return add_forces(first, second, point, &force, 1);
}

int ConstraintRows::add_torque(const TreeBody& first, const TreeBody& second, const Vector3& axis) {
  const SpatialLanes torque{lanes_of(axis), Four{}};
  return add_forces(first, second, Vector3(), &torque, 1);
}

void ConstraintRows::add_torque_to_last(const TreeBody& first, const TreeBody& second, const Vector3& axis) {
  const SpatialLanes torque{lanes_of(axis), Four{}};
  act(first, second, Vector3(), &torque, 1);
}

int ConstraintRows::add_dof(Tree& tree, int dof) {
  const int row = add_rows(1);
  values(rows_of(tree), 1)[dof] = 1;
  return row;
}

void ConstraintRows::set_of_contact(int row) { rows_[at(row)].singular = kOfContacts; }

void ConstraintRows::hold(int row, double error, double step, double drift) {
  set(row, -(kErrorReduction * error + drift) / step, kConstraintSoftness / step, 0);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  bound(row, -kInfinity, kInfinity);
}

void ConstraintRows::bound(int row, double lower, double upper) {
  ConeBlock& block = problem_.blocks.emplace_back();
  block.row = row;
  block.lower = lower;
  block.upper = upper;
}

void ConstraintRows::bound_by(int normal, double mu, int row, int size) {
  ConeBlock& block = problem_.blocks.emplace_back();
  block.row = row;
  block.size = size;
  block.normal = normal;
  block.mu = mu;
}

void ConstraintRows::set(int row, double target, double softness, double start) {
  rows_[at(row)].target = target;
  rows_[at(row)].softness = softness;
  rows_[at(row)].start = start;
}

/// Adds the part of a tree to the problem.
void ConstraintRows::gather(RowsOfTree& own) {
  const int rows = static_cast<int>(own.rows.size());
  own.solved.set_rows(own.given.data(), rows, own.tree->dofs(), own.width);
  sums_.resize(own.solved.length());
  own.solved.multiply(own.tree->rates().data(), sums_.data());
  for (std::size_t r = 0; r < own.rows.size(); ++r) problem_.b[own.rows[r]] -= sums_[r];
  const BranchedFactors& mass = own.tree->factors();
  mass.solve_upper(own.solved);
  if (is_of_one_tree()) return problem_.a.set_weighted_square(own.solved, mass.inverse_diagonals());
  square_.set_weighted_square(own.solved, mass.inverse_diagonals());
  for (int c = 0; c < rows; ++c) {
    for (int r = 0; r < rows; ++r) problem_.a(own.rows[at(r)], own.rows[at(c)]) += square_(r, c);
  }
}

/// u += L^-1 D^-1 L^-T J^T x
void ConstraintRows::apply(RowsOfTree& own) {
  const BranchedFactors& mass = own.tree->factors();
  const int dofs = own.tree->dofs();
  impulses_.assign(own.solved.length(), 0);
  for (std::size_t r = 0; r < own.rows.size(); ++r) impulses_[r] = problem_.x[own.rows[r]];
  sums_.resize(at(dofs));
  own.solved.multiply_transposed(impulses_.data(), sums_.data());
  for (int k = 0; k < dofs; ++k) sums_[at(k)] *= mass.inverse_diagonal(k);
  mass.solve_lower(sums_.data());
  for (int k = 0; k < dofs; ++k) own.tree->rates()[k] += sums_[at(k)];
}

BUBBLESIM_SIMD void ConstraintRows::add_impulses(const Tree& tree, std::vector<SpatialLanes>& links) const {
  for (const Action& action : actions_) {
    if (action.tree != &tree) continue;
    SpatialLanes& link = links[at(action.link)];
    for (int i = 0; i < action.count; ++i) link.add(problem_.x[action.row + i], action.forces[at(i)]);
  }
}

/// Leaves a row out along which nothing can move, such as that of a contact of a fixed link.
void ConstraintRows::leave_out(int row) {
  problem_.a.matrix().row(row).setZero();
  problem_.a.matrix().col(row).setZero();
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
  if (!is_of_one_tree()) problem_.a.set_zero(n, n);
  problem_.b.resize(n);
  problem_.x.resize(n);
  for (int r = 0; r < n; ++r) {
    problem_.b[r] = rows_[at(r)].target;
    problem_.x[r] = rows_[at(r)].start;
  }
  for (std::size_t i = 0; i < used_; ++i) gather(trees_[i]);
  const double largest = problem_.a.matrix().diagonal().maxCoeff();
  for (int c = 0; c < n; ++c) {
    if (problem_.a(c, c) <= kImmovable * largest) leave_out(c);
    problem_.a(c, c) += std::max(rows_[at(c)].softness, rows_[at(c)].singular * problem_.a(c, c));
  }
  pass_impacts_on();
  const ConeResult result = solver_.solve(problem_);
  for (std::size_t i = 0; i < used_; ++i) apply(trees_[i]);
  return result;
}

}  // namespace bubblesim
