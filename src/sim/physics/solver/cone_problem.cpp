// SPDX-License-Identifier: BSD-3-Clause
#include "physics/solver/cone_problem.hpp"

#include <algorithm>
#include <cmath>

namespace bubblesim {
namespace {

constexpr double kSmall = 1e-10;  // m/s, of a residual
constexpr double kGood = 1e-6;    // m/s, where bounds and contacts that repeat each other keep Newton from less
constexpr int kNewtonSteps = 12;
constexpr int kHalvings = 8;
constexpr int kSweepsAfterStall = 10;
constexpr int kLastSweeps = 100;

double bound_of(const ConeBlock& block, double normal) { return block.mu * std::max(normal, 0.0); }

double size_of(double x, double y) { return std::sqrt(x * x + y * y); }

/// The largest eigenvalue of the part of a disc.
double largest(const Columns& a, int row) {
  const double half = (a(row, row) - a(row + 1, row + 1)) / 2;
  return a(row, row) - half + std::sqrt(half * half + a(row, row + 1) * a(row, row + 1));
}

}  // namespace

double ConeSolver::evaluate(const ConeProblem& problem, const Eigen::VectorXd& x) {
  product_.resize(problem.a.length());
  problem.a.multiply(x.data(), product_.data());
  trial_.resize(x.size());
  residual_.resize(x.size());
  is_within_bounds_ = true;
  double merit = 0;
  const auto set_residual = [&](int row, double projected) {
    residual_[row] = (x[row] - projected) * admittance_[row];
    merit += residual_[row] * residual_[row];
  };
  for (const ConeBlock& block : problem.blocks) {
    const int r = block.row;
    for (int k = r; k < r + block.size; ++k) {
      trial_[k] = x[k] - scale_[k] * (product_[static_cast<std::size_t>(k)] - problem.b[k]);
    }
    const double bound = block.normal < 0 ? 0 : bound_of(block, trial_[block.normal]);
    if (block.size == 1) {
      const double lower = block.normal < 0 ? block.lower : -bound;
      const double upper = block.normal < 0 ? block.upper : bound;
      set_residual(r, std::clamp(trial_[r], lower, upper));
      is_within_bounds_ = is_within_bounds_ && trial_[r] > lower && trial_[r] < upper;
      continue;
    }
    const double size = size_of(trial_[r], trial_[r + 1]);
    const double part = size > bound ? bound / size : 1;
    for (int k = r; k < r + 2; ++k) set_residual(k, part * trial_[k]);
    is_within_bounds_ = is_within_bounds_ && size <= bound;
  }
  return merit;
}

/// The slope of the residual at the last point that was evaluated.
void ConeSolver::differentiate(const ConeProblem& problem) {
  const auto a = problem.a.matrix();
  slope_.resize(a.rows(), a.cols());
  // The slope of the trial is I - scale A.
  const auto trial_slope = [&](int row) {
    Eigen::RowVectorXd made = -scale_[row] * a.row(row);
    made[row] += 1;
    return made;
  };
  for (const ConeBlock& block : problem.blocks) {
    const int r = block.row;
    const bool loaded = block.normal >= 0 && trial_[block.normal] > 0;
    const double bound = block.normal < 0 ? 0 : bound_of(block, trial_[block.normal]);
    if (block.size == 1) {
      const double lower = block.normal < 0 ? block.lower : -bound;
      const double upper = block.normal < 0 ? block.upper : bound;
      if (trial_[r] > lower && trial_[r] < upper) {
        slope_.row(r) = a.row(r);
        continue;
      }
      slope_.row(r).setZero();
      slope_(r, r) = 1 / scale_[r];
      if (loaded) {
        slope_.row(r) -= std::copysign(block.mu, trial_[r]) / scale_[r] * trial_slope(block.normal);
      }
      continue;
    }
    const double size = size_of(trial_[r], trial_[r + 1]);
    if (size <= bound) {
      slope_.middleRows(r, 2) = a.middleRows(r, 2);
      continue;
    }
    const double u[2] = {trial_[r] / size, trial_[r + 1] / size};
    const Eigen::RowVectorXd first = trial_slope(r);
    const Eigen::RowVectorXd second = trial_slope(r + 1);
    const Eigen::RowVectorXd across = bound / size * (first * -u[1] + second * u[0]);
    for (int k = 0; k < 2; ++k) {
      slope_.row(r + k) = across * (k == 0 ? u[1] : -u[0]);
      slope_(r + k, r + k) += 1;
      if (loaded) slope_.row(r + k) -= block.mu * u[k] * trial_slope(block.normal);
      slope_.row(r + k) /= scale_[r + k];
    }
  }
}

void ConeSolver::sweep(ConeProblem& problem) {
  const auto a = problem.a.matrix();
  Eigen::VectorXd& x = problem.x;
  for (const ConeBlock& block : problem.blocks) {
    const int r = block.row;
    const double bound = block.normal < 0 ? 0 : bound_of(block, x[block.normal]);
    if (block.size == 1) {
      const double wanted = x[r] - (a.row(r).dot(x) - problem.b[r]) / a(r, r);
      x[r] = block.normal < 0 ? std::clamp(wanted, block.lower, block.upper) : std::clamp(wanted, -bound, bound);
      continue;
    }
    double t[2];
    for (int k = 0; k < 2; ++k) t[k] = x[r + k] - scale_[r + k] * (a.row(r + k).dot(x) - problem.b[r + k]);
    const double size = size_of(t[0], t[1]);
    for (int k = 0; k < 2; ++k) x[r + k] = size > bound ? t[k] * (bound / size) : t[k];
  }
}

ConeResult ConeSolver::solve(ConeProblem& problem) {
  ConeResult result;
  const Eigen::Index rows = problem.b.size();
  if (rows == 0) return result;
  scale_.resize(rows);
  admittance_.resize(rows);
  for (const ConeBlock& block : problem.blocks) {
    const double admittance = block.size == 1 ? problem.a(block.row, block.row) : largest(problem.a, block.row);
    for (int k = block.row; k < block.row + block.size; ++k) {
      admittance_[k] = admittance;
      scale_[k] = 1 / admittance;
    }
  }
  const double enough = kSmall * kSmall * static_cast<double>(rows);
  const double good = kGood * kGood * static_cast<double>(rows);
  double merit = evaluate(problem, problem.x);
  while (merit > enough && result.newton_steps < kNewtonSteps) {
    ++result.newton_steps;
    if (is_within_bounds_) {
      step_ = residual_;
      whole_.solve(problem.a, step_.data());
    } else {
      differentiate(problem);
      step_ = sloped_.compute(slope_).solve(residual_);
    }
    before_ = problem.x;
    double next = std::numeric_limits<double>::infinity();
    double part = 1;
    for (int i = 0; i < kHalvings && step_.allFinite(); ++i, part /= 2) {
      problem.x = before_ - part * step_;
      next = evaluate(problem, problem.x);
      if (next < (1 - part / 10) * merit) break;
    }
    if (!(next < merit)) {
      problem.x = before_;
      if (merit <= good) break;
      for (int i = 0; i < kSweepsAfterStall; ++i) sweep(problem);
      result.sweeps += kSweepsAfterStall;
      next = evaluate(problem, problem.x);
    }
    merit = next;
  }
  // Sweeps converge slowly, but where they end there is a solution.
  for (int i = 0; i < kLastSweeps && merit > good; ++i) {
    sweep(problem);
    ++result.sweeps;
    if (i % 10 == 9) merit = evaluate(problem, problem.x);
  }
  result.residual = std::sqrt(merit);
  return result;
}

}  // namespace bubblesim
