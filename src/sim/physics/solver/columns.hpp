// SPDX-License-Identifier: BSD-3-Clause
// Small dense matrices of the constraint solver.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace bubblesim {

/// A matrix by columns, whose rows are filled up with zeros to a multiple of four: loops over a column have no rest,
/// and cost half of those of Eigen's matrices of about ten rows.
class Columns {
 public:
  void set_zero(int rows, int columns) {
    rows_ = rows;
    length_ = (rows + 3) / 4 * 4;
    values_.assign(static_cast<std::size_t>(length_) * static_cast<std::size_t>(columns), 0);
  }
  int rows() const { return rows_; }
  double* operator[](int column) { return values_.data() + static_cast<std::ptrdiff_t>(column) * length_; }
  const double* operator[](int column) const { return values_.data() + static_cast<std::ptrdiff_t>(column) * length_; }

  /// Adds a multiple of a column of this length to another, from the group of four of row `first`.
  void add(double* to, double factor, const double* column, int first = 0) const {
    for (int i = first / 4 * 4; i < length_; i += 4) {
      Eigen::Map<Eigen::Array4d>(to + i) += factor * Eigen::Map<const Eigen::Array4d>(column + i);
    }
  }

 private:
  int rows_ = 0;
  int length_ = 0;
  std::vector<double> values_;
};

}  // namespace bubblesim
