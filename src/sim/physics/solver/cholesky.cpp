// SPDX-License-Identifier: BSD-3-Clause
#include "physics/solver/cholesky.hpp"

#include "scene/simd.hpp"

namespace bubblesim {

BUBBLESIM_SIMD void Cholesky::solve(const Columns& a, double* x) {
  const int n = a.rows();
  const auto size = static_cast<std::size_t>(n);
  // Below the matrix is a row with x: its elimination is half of the solution.
  lower_.resize(n + 1, n);
  const std::size_t last = size / 4 * 4;  // the group of this row
  Four place = {};
  place[n % 4] = 1;
  for (int c = 0; c < n; ++c) {
    double* const to = lower_[c];
    for (std::size_t r = static_cast<std::size_t>(c) / 4 * 4; r < last; r += 4) store_four(to + r, load_four(a[c] + r));
    store_four(to + last, (last < a.length() ? load_four(a[c] + last) : Four{}) + place * x[c]);
  }
  for (int k = 0; k < n; ++k) {
    double* const own = lower_[k];
    const double inverse = 1 / own[k];
    for (int c = k + 1; c < n; ++c) {
      const std::size_t first = static_cast<std::size_t>(c) / 4 * 4;
      add_multiple(lower_[c] + first, -own[c] * inverse, own + first, lower_.length() - first);
    }
    for (std::size_t r = static_cast<std::size_t>(k) / 4 * 4; r < lower_.length(); r += 4) {
      store_four(own + r, load_four(own + r) * inverse);
    }
  }
  for (int k = n - 1; k >= 0; --k) {
    const double* const own = lower_[k];
    double left = own[n];
    for (int r = n - 1; r > k; --r) left -= own[r] * x[r];  // the number that was found last comes last
    x[k] = left;
  }
}

}  // namespace bubblesim
