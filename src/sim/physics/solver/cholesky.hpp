// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "physics/solver/columns.hpp"

namespace bubblesim {

/// Factors L D L^T of a small symmetric positive definite matrix.
class Cholesky {
 public:
  void factor(const Eigen::MatrixXd& matrix) {
    const int n = static_cast<int>(matrix.rows());
    lower_.set_zero(n, n);
    inverse_.resize(n);
    for (int c = 0; c < n; ++c) {
      for (int r = c; r < n; ++r) lower_[c][r] = matrix(r, c);
    }
    for (int k = 0; k < n; ++k) {
      double* own = lower_[k];
      inverse_[k] = 1 / own[k];
      for (int c = k + 1; c < n; ++c) lower_.add(lower_[c], -own[c] * inverse_[k], own, c);
      for (int r = k + 1; r < n; ++r) own[r] *= inverse_[k];
    }
  }

  /// Replaces x by the solution.
  void solve(Eigen::VectorXd& x) const {
    const int n = lower_.rows();
    for (int k = 0; k < n; ++k) {
      for (int r = k + 1; r < n; ++r) x[r] -= lower_[k][r] * x[k];
    }
    for (int k = n - 1; k >= 0; --k) {
      x[k] *= inverse_[k];
      for (int r = k + 1; r < n; ++r) x[k] -= lower_[k][r] * x[r];
    }
  }

 private:
  Columns lower_;  // above the diagonal: anything
  Eigen::VectorXd inverse_;
};

}  // namespace bubblesim
