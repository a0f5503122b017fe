// SPDX-License-Identifier: BSD-3-Clause
// Symmetric matrices of the degrees of freedom of a tree, and their factors L^T D L that keep the zeros of branches
// (R. Featherstone, "Rigid Body Dynamics Algorithms", 2008, section 6.5).
#pragma once

#include <cstddef>
#include <vector>

#include "physics/solver/columns.hpp"

namespace bubblesim {

/// Elements of two degrees of freedom are 0 unless one of them is on the way of the other to the world.
class BranchedMatrix {
 public:
  /// Adds a degree of freedom behind another one; -1: behind the world. Returns its number.
  int add(int before);
  int size() const { return static_cast<int>(dofs_.size()); }
  /// The degree of freedom before another on the way to the world; -1: none.
  int before(int dof) const { return dofs_[index(dof)].before; }
  /// The first of the degrees of freedom that lead to this one with consecutive numbers.
  int first_of_run(int dof) const { return dofs_[index(dof)].run; }

  void set_zero() { values_.assign(values_.size(), 0); }
  /// Element of a degree of freedom and of another one on its way to the world, or itself. The next elements are those
  /// of the next ones on this way. Valid until factor() was called.
  double& entry(int dof, int before) { return values_[dofs_[index(dof)].row + dofs_[index(before)].depth]; }
  double entry(int dof, int before) const { return values_[dofs_[index(dof)].row + dofs_[index(before)].depth]; }

  void factor();
  /// Half the way of a solution: y = L^-T y.
  void solve_upper(double* y) const;
  /// Likewise for each row of y: y = y L^-1.
  void solve_upper(Columns& y) const;
  /// y = L^-1 y.
  void solve_lower(double* y) const;
  /// Of D, by degree of freedom.
  double inverse_diagonal(int dof) const { return inverse_diagonal_[index(dof)]; }
  const double* inverse_diagonals() const { return inverse_diagonal_.data(); }

 private:
  struct Dof {
    int before;
    int run;
    std::size_t depth;
    std::size_t row;  // of its first element, in groups of four up to the diagonal: above it is anything
  };
  static std::size_t index(int number) { return static_cast<std::size_t>(number); }

  std::vector<Dof> dofs_;
  std::vector<double> values_;
  std::vector<double> inverse_diagonal_;
  std::vector<double> parts_;  // working memory: a row of L
};

}  // namespace bubblesim
