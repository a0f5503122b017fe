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
  void eliminate_before(int first);
  void eliminate_among(int first, int end);

  // Above the squares of four on the diagonal: anything.
  Columns scaled_;  // L D, with x as a row below
  Columns unit_;    // L, with the solution of L D y = x
};

}  // namespace bubblesim
