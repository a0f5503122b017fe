// SPDX-License-Identifier: BSD-3-Clause
// Factors of a symmetric matrix that is mostly zero, such as that of the joints of a mechanism.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bubblesim {

/// L D L^T of a symmetric positive definite matrix. The order of elimination is that of least degree: for the joints of
/// a tree of links nothing is filled in, and the cost grows with the number of joints instead of its cube.
class SparseLdlt {
 public:
  /// Factors the rows and columns `chosen`, in ascending order, of a matrix of which the lower triangle is read: row i
  /// begins at `matrix` + i * `skip`. Returns false when that part is not positive definite.
  bool factor(const double* matrix, std::size_t skip, const std::vector<std::uint32_t>& chosen);

  /// The number of entries of L below its diagonal.
  std::size_t entries() const { return row_.size(); }
  /// In the order of elimination: index into `chosen`.
  const std::vector<std::uint32_t>& order() const { return order_; }
  /// The diagonal of D, in the order of elimination.
  const std::vector<double>& diagonal() const { return diagonal_; }

  /// Replaces x by L^-1 x; x is in the order of elimination.
  void solve_lower(double* x) const;
  /// Replaces x by L^-T x, likewise.
  void solve_upper(double* x) const;

 private:
  void find_order(const double* matrix, std::size_t skip, const std::vector<std::uint32_t>& chosen);
  bool compute(const double* matrix, std::size_t skip, const std::vector<std::uint32_t>& chosen);

  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> place_;  // of an index in the order
  std::vector<double> diagonal_;
  std::vector<std::size_t> start_;  // of a column of L in the following; a column has the rows below its diagonal
  std::vector<std::uint32_t> row_;
  std::vector<double> value_;
  std::vector<std::uint64_t> pattern_;  // of the matrix for which the order was found, a bit for each entry
  // Working memory:
  std::vector<std::uint64_t> adjacent_;
  std::vector<int> degree_;
  std::vector<double> column_;
  std::vector<std::uint32_t> next_;  // the next column whose rows continue in the same row
  std::vector<std::uint32_t> head_;
  std::vector<std::size_t> at_;
};

}  // namespace bubblesim
