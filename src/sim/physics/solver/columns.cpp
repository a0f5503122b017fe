// SPDX-License-Identifier: BSD-3-Clause
#include "physics/solver/columns.hpp"

#include "scene/simd.hpp"

namespace bubblesim {

BUBBLESIM_SIMD void Columns::set_weighted_square(const Columns& a, const double* weights) {
  resize(a.rows(), a.rows());
  // By squares of four rows and columns, whose sums stay in registers.
  for (std::size_t c = 0; c < a.length_; c += 4) {
    for (std::size_t r = c; r < a.length_; r += 4) {
      Four sums[4] = {};
      const double* column = a.values_.data();
      for (int k = 0; k < a.columns_; ++k, column += a.length_) {
        const Four factors = weights[k] * load_four(column + c);
        const Four rows = load_four(column + r);
        for (int j = 0; j < 4; ++j) sums[j] += factors[j] * rows;
      }
      double* const to = values_.data() + c * length_ + r;
      for (std::size_t j = 0; j < 4 && c + j < static_cast<std::size_t>(columns_); ++j) {
        store_four(to + j * length_, sums[j]);
      }
    }
  }
}

}  // namespace bubblesim
