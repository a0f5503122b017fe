// SPDX-License-Identifier: BSD-3-Clause
#include "physics/solver/cholesky.hpp"

#include <algorithm>

#include "scene/simd.hpp"

namespace bubblesim {

/// Subtracts from four columns what those before take, by squares whose sums stay in registers.
BUBBLESIM_INLINE void Cholesky::eliminate_before(int first) {
  const auto top = static_cast<std::size_t>(first);
  const int width = std::min(4, scaled_.columns() - first);
  for (std::size_t r = top; r < scaled_.length(); r += 4) {
    Four sums[4] = {};
    for (int j = 0; j < width; ++j) sums[j] = load_four(scaled_[first + j] + r);
    for (int k = 0; k < first; ++k) {
      const Four factors = load_four(unit_[k] + top);
      const Four own = load_four(scaled_[k] + r);
      for (int j = 0; j < 4; ++j) sums[j] -= factors[j] * own;
    }
    for (int j = 0; j < width; ++j) store_four(scaled_[first + j] + r, sums[j]);
  }
}

/// Completes a few columns.
BUBBLESIM_INLINE void Cholesky::eliminate_among(int first, int end) {
  const auto top = static_cast<std::size_t>(first);
  for (int k = first; k < end; ++k) {
    const double* const own = scaled_[k];
    const double inverse = 1 / own[k];
    for (int c = k + 1; c < end; ++c) {
      add_multiple(scaled_[c] + top, -own[c] * inverse, own + top, scaled_.length() - top);
    }
    for (std::size_t r = top; r < scaled_.length(); r += 4) store_four(unit_[k] + r, load_four(own + r) * inverse);
  }
}

BUBBLESIM_SIMD void Cholesky::solve(const Columns& a, double* x) {
  const int n = a.rows();
  const auto size = static_cast<std::size_t>(n);
  // Below the matrix is a row with x: its elimination is half of the solution.
  scaled_.resize(n + 1, n);
  unit_.resize(n + 1, n);
  const std::size_t last = size / 4 * 4;  // the group of this row
  Four place = {};
  place[n % 4] = 1;
  for (int c = 0; c < n; ++c) {
    double* const to = scaled_[c];
    for (std::size_t r = static_cast<std::size_t>(c) / 4 * 4; r < last; r += 4) store_four(to + r, load_four(a[c] + r));
    store_four(to + last, (last < a.length() ? load_four(a[c] + last) : Four{}) + place * x[c]);
  }
  for (int c = 0; c < n; c += 4) {
    eliminate_before(c);
    eliminate_among(c, std::min(c + 4, n));
  }
  for (int k = n - 1; k >= 0; --k) {
    const double* const own = unit_[k];
    double left = own[n];
    for (int r = n - 1; r > k; --r) left -= own[r] * x[r];  // the number that was found last comes last
    x[k] = left;
  }
}

}  // namespace bubblesim
