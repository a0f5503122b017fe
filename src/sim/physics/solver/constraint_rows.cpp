// SPDX-License-Identifier: BSD-3-Clause
#include "physics/solver/constraint_rows.hpp"

#include <algorithm>
#include <cmath>

namespace bubblesim {
namespace {

constexpr Eigen::Index kFew = 32;   // rows, for which Eigen's blocks for large products do not pay
constexpr double kSingular = 1e-9;  // of a diagonal element, added where rows repeat each other

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

std::size_t at(int number) { return static_cast<std::size_t>(number); }

}  // namespace

void ConstraintRows::clear() {
  rows_.clear();
  used_ = 0;
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
  for (int k = body.tree->last_dof(body.link); k >= 0; k = body.tree->before(k)) {
    const TreeColumn& column = body.tree->column(k);
    own[k] += column.turn.dot(moment) + column.slide.dot(force);
  }
}

int ConstraintRows::add(const TreeBody& first, const TreeBody& second, const Vector3& turn, const Vector3& push,
                        const Vector3& point) {
  rows_.emplace_back();
  add_way(first, turn, push, point, 1);
  add_way(second, turn, push, point, -1);
  return count() - 1;
}

int ConstraintRows::add_force(const TreeBody& first, const TreeBody& second, const Vector3& point,
                              const Vector3& direction) {
  return add(first, second, Vector3(), direction, point);
}

int ConstraintRows::add_torque(const TreeBody& first, const TreeBody& second, const Vector3& axis) {
  return add(first, second, axis, Vector3(), Vector3());
}

int ConstraintRows::add_dof(Tree& tree, int dof) {
  rows_.emplace_back();
  values(tree)[dof] = 1;
  return count() - 1;
}

void ConstraintRows::set(int row, double target, double softness, double start) {
  rows_[at(row)] = {target, softness, start};
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
  for (std::size_t i = 0; i < used_; ++i) {
    RowsOfTree& own = trees_[i];
    const auto count = static_cast<Eigen::Index>(own.rows.size());
    own.solved = Eigen::Map<const RowMajor>(own.given.data(), count, own.tree->dofs());
    part_.noalias() = own.solved * own.tree->rates();
    own.tree->solve_upper(own.solved);
    for (int k = 0; k < own.tree->dofs(); ++k) own.solved.col(k) *= std::sqrt(own.tree->inverse_diagonal(k));
    if (count <= kFew) {
      square_.noalias() = own.solved.lazyProduct(own.solved.transpose());
    } else {
      square_.noalias() = own.solved * own.solved.transpose();
    }
    for (Eigen::Index c = 0; c < count; ++c) {
      const int column = own.rows[static_cast<std::size_t>(c)];
      problem_.b[column] -= part_[c];
      for (Eigen::Index r = 0; r < count; ++r)
        problem_.a(own.rows[static_cast<std::size_t>(r)], column) += square_(r, c);
    }
  }
  for (int r = 0; r < n; ++r) {
    problem_.a(r, r) += std::max(rows_[at(r)].softness, kSingular * problem_.a(r, r));
  }
  const ConeResult result = solver_.solve(problem_);
  // u += L^-1 D^-1 L^-T J^T x
  for (std::size_t i = 0; i < used_; ++i) {
    const RowsOfTree& own = trees_[i];
    part_.resize(own.solved.rows());
    for (Eigen::Index r = 0; r < part_.size(); ++r) part_[r] = problem_.x[own.rows[static_cast<std::size_t>(r)]];
    change_.noalias() = own.solved.transpose() * part_;
    for (int k = 0; k < own.tree->dofs(); ++k) change_[k] *= std::sqrt(own.tree->inverse_diagonal(k));
    own.tree->solve_lower(change_.data());
    own.tree->rates() += change_;
  }
  return result;
}

}  // namespace bubblesim
