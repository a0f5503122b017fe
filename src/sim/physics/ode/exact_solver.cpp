// SPDX-License-Identifier: BSD-3-Clause
// Eliminates the joints of large mechanisms before ODE's exact solver, whose cost grows with the cube of all rows of an
// island: see docs/adr/0039.
//
// ODE solves A x = b + w with lo <= x <= hi; w is 0 unless x is at a limit. Most rows are those of joints: they have no
// limits (j), and A is mostly zero among them. With the factors of that part, the rows with limits (l: stops, motors,
// contacts) are left to ODE: S = A_ll - A_lj A_jj^-1 A_jl.
#include <dlfcn.h>
#include <ode/ode.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "physics/ode/sparse_ldlt.hpp"

struct dxWorldProcessMemArena;

// ODE's solver. `values` has b and x of each row, `limits` lo and hi. Rows before `unlimited` have no limits. The
// limits of a row with limit_of >= 0 are those that the solution of that row gives, multiplied. Of A, the lower
// triangle is read. The linker replaces the function by this one.
void dxSolveLCP(dxWorldProcessMemArena* memory, unsigned rows, double* matrix, double* values, double* w,
                unsigned unlimited, double* limits, int* limit_of);

namespace bubblesim {
namespace {

using SolveLcp = decltype(&dxSolveLCP);

/// Joint rows below which ODE's solver is as fast.
constexpr std::size_t kFewRows = 48;

/// The length of ODE's rows of a matrix.
std::size_t padded(std::size_t columns) { return columns > 1 ? (columns + 3) / 4 * 4 : columns; }

SolveLcp ode_lcp_solver() {
  static const auto found = reinterpret_cast<SolveLcp>(
      dlsym(RTLD_NEXT, "_Z10dxSolveLCPP22dxWorldProcessMemArenajPdS1_S1_jS1_Pi"));  // NOLINT: a function
  return found;
}

/// Working memory is kept for the next problem.
class JointElimination {
 public:
  /// Returns false, and leaves all as it is, when the problem is not of this kind.
  bool solve(dxWorldProcessMemArena* memory, unsigned rows, double* matrix, double* values, unsigned unlimited,
             const double* limits, const int* limit_of) {
    if (!divide(rows, unlimited, limits, limit_of)) return false;
    const std::size_t skip = padded(rows);
    if (!factors_.factor(matrix, skip, joints_)) return false;
    couple(matrix, skip, values);
    if (!limited_.empty()) {
      reduce(matrix, skip, values, limits, limit_of);
      ode_lcp_solver()(memory, static_cast<unsigned>(limited_.size()), matrix, values_.data(), nullptr, 0,
                       limits_.data(), limit_of == nullptr ? nullptr : limit_of_.data());
    }
    insert(values);
    return true;
  }

 private:
  bool divide(unsigned rows, unsigned unlimited, const double* limits, const int* limit_of) {
    joints_.clear();
    limited_.clear();
    place_.assign(rows, -1);
    for (std::uint32_t i = 0; i < rows; ++i) {
      const bool depends = limit_of != nullptr && limit_of[i] >= 0;
      if (i < unlimited || (!depends && limits[2 * i] == -dInfinity && limits[2 * i + 1] == dInfinity)) {
        joints_.push_back(i);
      } else {
        place_[i] = static_cast<int>(limited_.size());
        limited_.push_back(i);
      }
    }
    if (joints_.size() < kFewRows) return false;
    return std::all_of(limited_.begin(), limited_.end(), [&](std::uint32_t i) {
      return limit_of == nullptr || limit_of[i] < 0 || place_[static_cast<std::size_t>(limit_of[i])] >= 0;
    });
  }

  static double entry(const double* matrix, std::size_t skip, std::uint32_t a, std::uint32_t b) {
    return a < b ? matrix[b * skip + a] : matrix[a * skip + b];
  }

  double* coupling(std::size_t limited) { return &coupling_[limited * joints_.size()]; }

  /// L^-1 b_j and L^-1 A_jl.
  void couple(const double* matrix, std::size_t skip, const double* values) {
    const std::size_t n = joints_.size();
    const std::vector<std::uint32_t>& order = factors_.order();
    right_.resize(n);
    for (std::size_t p = 0; p < n; ++p) right_[p] = values[2 * joints_[order[p]]];
    factors_.solve_lower(right_.data());
    coupling_.resize(n * limited_.size());
    touched_.resize(limited_.size());
    for (std::size_t l = 0; l < limited_.size(); ++l) {
      double* column = coupling(l);
      for (std::size_t p = 0; p < n; ++p) column[p] = entry(matrix, skip, limited_[l], joints_[order[p]]);
      factors_.solve_lower(column);
      touched_[l].clear();
      for (std::uint32_t p = 0; p < n; ++p) {
        if (column[p] != 0) touched_[l].push_back(p);
      }
    }
  }

  /// Puts S where A was, whose rows come later in memory.
  void reduce(double* matrix, std::size_t skip, const double* values, const double* limits, const int* limit_of) {
    const std::size_t count = limited_.size();
    const std::size_t own_skip = padded(count);
    const std::vector<double>& diagonal = factors_.diagonal();
    values_.assign(2 * count, 0);
    limits_.resize(2 * count);
    limit_of_.assign(count, -1);
    scaled_.resize(joints_.size());
    for (std::size_t l = 0; l < count; ++l) {
      const std::uint32_t row = limited_[l];
      double known = values[2 * row];
      for (const std::uint32_t p : touched_[l]) {
        scaled_[p] = coupling(l)[p] / diagonal[p];
        known -= scaled_[p] * right_[p];
      }
      values_[2 * l] = known;
      limits_[2 * l] = limits[2 * row];
      limits_[2 * l + 1] = limits[2 * row + 1];
      if (limit_of != nullptr && limit_of[row] >= 0) limit_of_[l] = place_[static_cast<std::size_t>(limit_of[row])];
      for (std::size_t m = 0; m <= l; ++m) {
        const double* other = coupling(m);
        double sum = entry(matrix, skip, row, limited_[m]);
        for (const std::uint32_t p : touched_[l]) sum -= scaled_[p] * other[p];
        matrix[l * own_skip + m] = sum;
      }
      std::fill(matrix + l * own_skip + l + 1, matrix + (l + 1) * own_skip, 0.0);
    }
  }

  /// x_j = L^-T D^-1 (L^-1 b_j - L^-1 A_jl x_l).
  void insert(double* values) {
    const std::vector<std::uint32_t>& order = factors_.order();
    for (std::size_t l = 0; l < limited_.size(); ++l) {
      const double found = values_[2 * l + 1];
      values[2 * limited_[l] + 1] = found;
      if (found == 0) continue;
      for (const std::uint32_t p : touched_[l]) right_[p] -= coupling(l)[p] * found;
    }
    for (std::size_t p = 0; p < right_.size(); ++p) right_[p] /= factors_.diagonal()[p];
    factors_.solve_upper(right_.data());
    for (std::size_t p = 0; p < right_.size(); ++p) values[2 * joints_[order[p]] + 1] = right_[p];
  }

  SparseLdlt factors_;
  std::vector<std::uint32_t> joints_;                // rows of the problem
  std::vector<std::uint32_t> limited_;               // likewise
  std::vector<int> place_;                           // of a row in `limited_`; -1 of a joint's
  std::vector<double> right_;                        // by the order of elimination
  std::vector<double> coupling_;                     // columns, one for each limited row
  std::vector<std::vector<std::uint32_t>> touched_;  // rows of the columns that are not zero
  std::vector<double> scaled_;
  std::vector<double> values_;
  std::vector<double> limits_;
  std::vector<int> limit_of_;
};

}  // namespace
}  // namespace bubblesim

void dxSolveLCP(dxWorldProcessMemArena* memory, unsigned rows, double* matrix, double* values, double* w,
                unsigned unlimited, double* limits, int* limit_of) {
  thread_local bubblesim::JointElimination elimination;
  if (w == nullptr && elimination.solve(memory, rows, matrix, values, unlimited, limits, limit_of)) return;
  bubblesim::ode_lcp_solver()(memory, rows, matrix, values, w, unlimited, limits, limit_of);
}
