// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "physics/solver/columns.hpp"

namespace bubblesim {

/// Factors L D L^T of a small symmetric positive definite matrix.
class Cholesky {
 public:
  void factor(const Eigen::MatrixXd& matrix);
  /// Replaces x by the solution.
  void solve(Eigen::VectorXd& x) const;

 private:
  Columns lower_;  // above the diagonal: anything
  Eigen::VectorXd inverse_;
};

}  // namespace bubblesim
