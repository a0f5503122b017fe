// SPDX-License-Identifier: BSD-3-Clause
#include "physics/solver/constraint_rows.hpp"

#include <algorithm>

namespace bubblesim {
namespace {

constexpr double kSingular = 1e-9;  // of a diagonal element, added where rows repeat each other

std::size_t at(int number) { return static_cast<std::size_t>(number); }

}  // namespace

void ConstraintRows::clear() {
  rows_.clear();
  values_.clear();
  problem_.blocks.clear();
}

ConstraintRows::Side& ConstraintRows::side_of(Row& row, Tree* tree) {
  Side& side = row.sides[row.sides[0].tree == nullptr || row.sides[0].tree == tree ? 0 : 1];
  if (side.tree == nullptr) {
    side.tree = tree;
    side.given = values_.size();
    side.solved = side.given + at(tree->dofs());
    values_.resize(side.solved + at(tree->dofs()), 0);
  }
  return side;
}

void ConstraintRows::add_way(Row& row, const TreeBody& body, const Vector3& turn, const Vector3& push,
                             const Vector3& point, double sign) {
  if (body.tree == nullptr) return;
  Side& side = side_of(row, body.tree);
  const int leaf = body.tree->last_dof(body.link);
  side.leaves[side.leaves[0] < 0 ? 0 : 1] = leaf;
  const Vector3 moment = turn + (point - body.tree->origin()).cross(push);
  for (int k = leaf; k >= 0; k = body.tree->before(k)) {
    const TreeColumn& column = body.tree->column(k);
    values_[side.given + at(k)] += sign * (column.turn.dot(moment) + column.slide.dot(push));
  }
}

int ConstraintRows::add(const TreeBody& first, const TreeBody& second, const Vector3& turn, const Vector3& push,
                        const Vector3& point) {
  Row& row = rows_.emplace_back();
  add_way(row, first, turn, push, point, 1);
  add_way(row, second, turn, push, point, -1);
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
  Row& row = rows_.emplace_back();
  Side& side = side_of(row, &tree);
  side.leaves[0] = dof;
  values_[side.given + at(dof)] = 1;
  return count() - 1;
}

void ConstraintRows::set(int row, double target, double softness, double start) {
  rows_[at(row)].target = target;
  rows_[at(row)].softness = softness;
  rows_[at(row)].start = start;
}

double ConstraintRows::velocity(int number) const {
  double sum = 0;
  for (const Side& side : rows_[at(number)].sides) {
    if (side.tree == nullptr) continue;
    for (int k = 0; k < side.tree->dofs(); ++k) sum += values_[side.given + at(k)] * side.tree->rates()[k];
  }
  return sum;
}

double ConstraintRows::product(const Side& a, const Side& b) const {
  if (a.tree == nullptr || a.tree != b.tree) return 0;
  double sum = 0;
  const double* first = &values_[a.solved];
  const double* second = &values_[b.solved];
  const int last = std::min(std::max(a.leaves[0], a.leaves[1]), std::max(b.leaves[0], b.leaves[1]));
  for (int k = 0; k <= last; ++k) sum += first[k] * second[k] * a.tree->inverse_diagonal(k);
  return sum;
}

ConeResult ConstraintRows::solve() {
  const int n = count();
  if (n == 0) return {};
  problem_.a.resize(n, n);
  problem_.b.resize(n);
  problem_.x.resize(n);
  for (int r = 0; r < n; ++r) {
    Row& row = rows_[at(r)];
    for (const Side& side : row.sides) {
      if (side.tree == nullptr) continue;
      std::copy_n(&values_[side.given], side.tree->dofs(), &values_[side.solved]);
      const int last = std::max(side.leaves[0], side.leaves[1]);
      const bool forks = side.leaves[0] >= 0 && side.leaves[1] >= 0;
      if (last >= 0) side.tree->solve_upper(&values_[side.solved], forks ? -1 : last);
    }
    for (int s = 0; s <= r; ++s) {
      double sum = 0;
      for (const Side& mine : row.sides) {
        for (const Side& other : rows_[at(s)].sides) sum += product(mine, other);
      }
      problem_.a(r, s) = problem_.a(s, r) = sum;
    }
    problem_.a(r, r) += std::max(row.softness, kSingular * problem_.a(r, r));
    problem_.b[r] = row.target - velocity(r);
    problem_.x[r] = row.start;
  }
  const ConeResult result = solver_.solve(problem_);
  // u += L^-1 D^-1 L^-T J^T x, tree by tree.
  for (int r = 0; r < n; ++r) {
    for (const Side& side : rows_[at(r)].sides) {
      if (side.tree == nullptr || problem_.x[r] == 0) continue;
      Tree& tree = *side.tree;
      change_.assign(at(tree.dofs()), 0);
      for (int k = 0; k < tree.dofs(); ++k) {
        change_[at(k)] = values_[side.solved + at(k)] * tree.inverse_diagonal(k) * problem_.x[r];
      }
      tree.solve_lower(change_.data());
      for (int k = 0; k < tree.dofs(); ++k) tree.rates()[k] += change_[at(k)];
    }
  }
  return result;
}

}  // namespace bubblesim
