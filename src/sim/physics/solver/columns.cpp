// SPDX-License-Identifier: BSD-3-Clause
#include "physics/solver/columns.hpp"

#include "scene/simd.hpp"

namespace bubblesim {

namespace {

/// Numbers of two groups, in turns.
BUBBLESIM_INLINE Four even(const Four& a, const Four& b) { return Four{a[0], b[0], a[2], b[2]}; }
BUBBLESIM_INLINE Four odd(const Four& a, const Four& b) { return Four{a[1], b[1], a[3], b[3]}; }
BUBBLESIM_INLINE Four first_halves(const Four& a, const Four& b) { return Four{a[0], a[1], b[0], b[1]}; }
BUBBLESIM_INLINE Four second_halves(const Four& a, const Four& b) { return Four{a[2], a[3], b[2], b[3]}; }

/// Four groups, by their first, second, third and fourth numbers.
BUBBLESIM_INLINE void transpose(Four* groups) {
  const Four even01 = even(groups[0], groups[1]);
  const Four odd01 = odd(groups[0], groups[1]);
  const Four even23 = even(groups[2], groups[3]);
  const Four odd23 = odd(groups[2], groups[3]);
  groups[0] = first_halves(even01, even23);
  groups[1] = first_halves(odd01, odd23);
  groups[2] = second_halves(even01, even23);
  groups[3] = second_halves(odd01, odd23);
}

}  // namespace

BUBBLESIM_SIMD void Columns::set_rows(const double* given, int rows, int columns, std::size_t stride) {
  resize(rows, columns);
  const auto height = static_cast<std::size_t>(rows);
  const auto width = static_cast<std::size_t>(columns);
  for (std::size_t r = 0; r < height; r += 4) {
    for (std::size_t c = 0; c < width; c += 4) {
      Four square[4] = {};
      for (std::size_t i = 0; i < 4 && r + i < height; ++i) square[i] = load_four(given + (r + i) * stride + c);
      transpose(square);
      double* const to = values_.data() + c * length_ + r;
      for (std::size_t j = 0; j < 4 && c + j < width; ++j) store_four(to + j * length_, square[j]);
    }
  }
}

BUBBLESIM_SIMD void Columns::set_weighted_square(const Columns& a, const double* weights) {
  resize(a.rows(), a.rows());
  const auto rows = static_cast<std::size_t>(rows_);
  // By squares of four rows and columns, whose sums stay in registers.
  for (std::size_t c = 0; c < a.length_; c += 4) {
    for (std::size_t r = c; r < a.length_; r += 4) {
      Four sums[4] = {};
      const double* column = a.values_.data();
      for (int k = 0; k < a.columns_; ++k, column += a.length_) {
        const Four factors = weights[k] * load_four(column + c);
        const Four others = load_four(column + r);
        for (int j = 0; j < 4; ++j) sums[j] += factors[j] * others;
      }
      double* const to = values_.data() + c * length_ + r;
      for (std::size_t j = 0; j < 4 && c + j < rows; ++j) store_four(to + j * length_, sums[j]);
      if (r == c) continue;
      transpose(sums);
      double* const beside = values_.data() + r * length_ + c;
      for (std::size_t j = 0; j < 4 && r + j < rows; ++j) store_four(beside + j * length_, sums[j]);
    }
  }
}

BUBBLESIM_SIMD void Columns::multiply(const double* vector, double* product) const {
  for (std::size_t r = 0; r < length_; r += 4) {
    Four sum = {};
    const double* column = values_.data() + r;
    for (int c = 0; c < columns_; ++c, column += length_) sum += vector[c] * load_four(column);
    store_four(product + r, sum);
  }
}

BUBBLESIM_SIMD void Columns::multiply_transposed(const double* vector, double* product) const {
  for (int c = 0; c < columns_; ++c) product[c] = dot((*this)[c], vector, length_);
}

}  // namespace bubblesim
