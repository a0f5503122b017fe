// SPDX-License-Identifier: BSD-3-Clause
#include "physics/solver/cholesky.hpp"

#include "scene/simd.hpp"

namespace bubblesim {

BUBBLESIM_SIMD void Cholesky::factor(const Eigen::MatrixXd& matrix) {
  const int n = static_cast<int>(matrix.rows());
  lower_.set_zero(n, n);
  inverse_.resize(n);
  for (int c = 0; c < n; ++c) {
    double* const to = lower_[c];
    const double* const from = matrix.data() + static_cast<std::ptrdiff_t>(c) * n;
    for (int r = c; r < n; ++r) to[r] = from[r];
  }
  double* const inverse = inverse_.data();
  for (int k = 0; k < n; ++k) {
    double* own = lower_[k];
    const double scale = inverse[k] = 1 / own[k];
    for (int c = k + 1; c < n; ++c) {
      const std::size_t first = static_cast<std::size_t>(c) / 4 * 4;
      add_multiple(lower_[c] + first, -own[c] * scale, own + first, lower_.length() - first);
    }
    for (int r = k + 1; r < n; ++r) own[r] *= scale;
  }
}

BUBBLESIM_SIMD void Cholesky::solve(Eigen::VectorXd& x) const {
  const int n = lower_.rows();
  double* const values = x.data();
  for (int k = 0; k < n; ++k) {
    const double* own = lower_[k];
    for (int r = k + 1; r < n; ++r) values[r] -= own[r] * values[k];
  }
  for (int k = n - 1; k >= 0; --k) {
    const auto first = static_cast<std::size_t>(k) + 1;
    values[k] = values[k] * inverse_[k] - dot(lower_[k] + first, values + first, static_cast<std::size_t>(n) - first);
  }
}

}  // namespace bubblesim
