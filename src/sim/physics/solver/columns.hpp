// SPDX-License-Identifier: BSD-3-Clause
// Small dense matrices of the constraint solver, and loops over rows of numbers.
#pragma once

#include <cstddef>
#include <vector>

#include "physics/solver/four.hpp"

namespace bubblesim {

/// Adds a multiple of numbers to others; `length` is a multiple of four.
inline void add_multiple(double* to, double factor, const double* from, std::size_t length) {
  for (std::size_t i = 0; i < length; i += 4) {
    store_four(to + i, load_four(to + i) + factor * load_four(from + i));
  }
}

/// The sum of products, in an order that does not depend on the instruction set.
inline double dot(const double* a, const double* b, std::size_t count) {
  Four sums = {};
  std::size_t i = 0;
  for (; i + 4 <= count; i += 4) sums += load_four(a + i) * load_four(b + i);
  double rest = 0;
  for (; i < count; ++i) rest += a[i] * b[i];
  return (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest;
}

/// A matrix by columns, whose rows are filled up with zeros to a multiple of four: loops over a column have no rest,
/// and cost half of those of Eigen's matrices of about ten rows.
class Columns {
 public:
  static std::size_t in_groups(std::size_t count) { return (count + 3) / 4 * 4; }

  void set_zero(int rows, int columns) {
    resize(rows, columns);
    values_.assign(values_.size(), 0);
  }
  int rows() const { return rows_; }
  int columns() const { return columns_; }
  std::size_t length() const { return length_; }  ///< of a column
  double* operator[](int column) { return values_.data() + static_cast<std::size_t>(column) * length_; }
  const double* operator[](int column) const { return values_.data() + static_cast<std::size_t>(column) * length_; }

  /// Makes this A W A^T, with a weight for each column of A: only the elements on and below the diagonal.
  void set_weighted_square(const Columns& a, const double* weights);

 private:
  /// The values are anything.
  void resize(int rows, int columns) {
    rows_ = rows;
    columns_ = columns;
    length_ = in_groups(static_cast<std::size_t>(rows));
    values_.resize(length_ * static_cast<std::size_t>(columns));
  }

  int rows_ = 0;
  int columns_ = 0;
  std::size_t length_ = 0;
  std::vector<double> values_;
};

}  // namespace bubblesim
