// SPDX-License-Identifier: BSD-3-Clause
// Factors L^T D L of symmetric matrices of the degrees of freedom of a tree, which keep the zeros of branches
// (R. Featherstone, "Rigid Body Dynamics Algorithms", 2008, section 6.5).
#pragma once

#include <cstddef>
#include <vector>

#include "physics/solver/columns.hpp"

namespace bubblesim {

/// L has a unit diagonal. Its elements of two degrees of freedom are 0 unless one of them is on the way of the other to
/// the world.
class BranchedFactors {
 public:
  /// Adds a degree of freedom behind another one; -1: behind the world. Returns its number.
  int add(int before);
  int size() const { return static_cast<int>(dofs_.size()); }
  /// The degree of freedom before another on the way to the world; -1: none.
  int before(int dof) const { return dofs_[index(dof)].before; }
  /// The first of the degrees of freedom that lead to this one with consecutive numbers.
  int first_of_run(int dof) const { return dofs_[index(dof)].run; }

  void set_zero() { values_.assign(values_.size(), 0); }
  /// Element of L of a degree of freedom and of another one on its way to the world. The next elements are those of the
  /// next ones on this way.
  double& entry(int dof, int before) { return values_[dofs_[index(dof)].row + dofs_[index(before)].depth]; }
  double entry(int dof, int before) const { return values_[dofs_[index(dof)].row + dofs_[index(before)].depth]; }
  /// Of D, by degree of freedom.
  void set_inverse_diagonal(int dof, double value) { inverse_diagonal_[index(dof)] = value; }
  double inverse_diagonal(int dof) const { return inverse_diagonal_[index(dof)]; }
  const double* inverse_diagonals() const { return inverse_diagonal_.data(); }

  /// Half the way of a solution for each row of y: y = y L^-1.
  void solve_upper(Columns& y) const;
  /// y = L^-1 y.
  void solve_lower(double* y) const;

 private:
  struct Dof {
    int before;
    int run;
    std::size_t depth;
    std::size_t row;  // of its first element
  };
  static std::size_t index(int number) { return static_cast<std::size_t>(number); }

  std::vector<Dof> dofs_;
  std::vector<double> values_;
  std::vector<double> inverse_diagonal_;
};

}  // namespace bubblesim
