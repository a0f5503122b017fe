// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "physics/solver/columns.hpp"

namespace bubblesim {

/// Solves by the factors L D L^T of a small symmetric positive definite matrix.
class Cholesky {
 public:
  /// Replaces x by the solution y of A y = x, of which the elements of A on and below the diagonal count.
  void solve(const Columns& a, double* x);

 private:
  Columns lower_;  // and x; above the diagonal: anything
};

}  // namespace bubblesim
