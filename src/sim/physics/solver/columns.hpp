// SPDX-License-Identifier: BSD-3-Clause
// Small dense matrices of the constraint solver, and loops over rows of numbers.
#pragma once

#include <Eigen/Core>
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

  /// The values are anything, also those that fill up.
  void resize(int rows, int columns) {
    rows_ = rows;
    columns_ = columns;
    length_ = in_groups(static_cast<std::size_t>(rows));
    values_.resize(length_ * static_cast<std::size_t>(columns));
  }
  void set_zero(int rows, int columns) {
    resize(rows, columns);
    values_.assign(values_.size(), 0);
  }
  int rows() const { return rows_; }
  int columns() const { return columns_; }
  std::size_t length() const { return length_; }  ///< of a column
  double* operator[](int column) { return values_.data() + static_cast<std::size_t>(column) * length_; }
  const double* operator[](int column) const { return values_.data() + static_cast<std::size_t>(column) * length_; }

  double& operator()(int row, int column) { return (*this)[column][row]; }
  double operator()(int row, int column) const { return (*this)[column][row]; }
  /// The same values, for what need not be fast.
  auto matrix() {
    return Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>(values_.data(), rows_, columns_, stride());
  }
  auto matrix() const {
    return Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>(values_.data(), rows_, columns_, stride());
  }

  /// Makes this the matrix whose rows are given, each with `stride` numbers, which is a multiple of four.
  void set_rows(const double* given, int rows, int columns, std::size_t stride);
  /// Makes this A W A^T, with a weight for each column of A.
  void set_weighted_square(const Columns& a, const double* weights);
  /// Sets `length()` numbers to the product with a vector.
  void multiply(const double* vector, double* product) const;
  /// Likewise one for each column to that of the transposed matrix with a vector of `length()` numbers.
  void multiply_transposed(const double* vector, double* product) const;

 private:
  Eigen::OuterStride<> stride() const { return Eigen::OuterStride<>(static_cast<Eigen::Index>(length_)); }

  int rows_ = 0;
  int columns_ = 0;
  std::size_t length_ = 0;
  std::vector<double> values_;
};

}  // namespace bubblesim
