// SPDX-License-Identifier: BSD-3-Clause
// The impulses of constraints with bounds: find x within its bounds so that the velocities v = A x - b vanish, but
// where a bound is reached, v drives x against it. Friction is Coulomb's, not associated: discs whose radius follows
// the normal impulse.
//
// A semi-smooth Newton method on the natural map x - P(x - r v) (Alart and Curnier, Computer Methods in Applied
// Mechanics and Engineering 92, 1991), with a line search; where it does not decrease, sweeps of projected
// Gauss-Seidel.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <limits>
#include <vector>

#include "physics/solver/cholesky.hpp"

namespace bubblesim {

/// One row within an interval, or two within a disc.
struct ConeBlock {
  int row = 0;
  int size = 1;
  double lower = -std::numeric_limits<double>::infinity();  ///< N s or N m s, without a normal
  double upper = std::numeric_limits<double>::infinity();
  int normal = -1;  ///< the row whose impulse bounds this one
  double mu = 0;    ///< the bound per impulse of that row
};

struct ConeProblem {
  Columns a;                      ///< 1/kg, symmetric but for rounding, and positive definite
  Eigen::VectorXd b;              ///< m/s or rad/s
  Eigen::VectorXd x;              ///< N s or N m s: the start, then the solution
  std::vector<ConeBlock> blocks;  ///< of all rows; the normal of a block has its block before
};

/// What a solution took and reached.
struct ConeResult {
  double residual = 0;  ///< m/s or rad/s
  int newton_steps = 0;
  int sweeps = 0;
};

class ConeSolver {
 public:
  ConeResult solve(ConeProblem& problem);

 private:
  double evaluate(const ConeProblem& problem, const Eigen::VectorXd& x);
  void differentiate(const ConeProblem& problem);
  void sweep(ConeProblem& problem);

  Eigen::VectorXd scale_;        // kg, of each row
  Eigen::VectorXd admittance_;   // 1/kg, its inverse
  std::vector<double> product_;  // m/s, A x
  Eigen::VectorXd residual_;     // m/s: (x - P(x - scale v)) / scale
  Eigen::VectorXd trial_;        // x - scale v
  bool is_within_bounds_;        // the trial is: then the slope of the residual is A
  Eigen::VectorXd before_, step_;
  Eigen::MatrixXd slope_;
  Cholesky whole_;                               // of A
  Eigen::PartialPivLU<Eigen::MatrixXd> sloped_;  // of the slope
};

}  // namespace bubblesim
