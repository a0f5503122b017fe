// SPDX-License-Identifier: BSD-3-Clause
#include "physics/solver/branched_matrix.hpp"

#include <algorithm>

#include "scene/simd.hpp"

namespace bubblesim {

int BranchedMatrix::add(int before) {
  const int number = size();
  const bool continues = before >= 0 && before == number - 1;
  const std::size_t depth = before < 0 ? 0 : dofs_[index(before)].depth + 1;
  dofs_.push_back({before, continues ? dofs_[index(before)].run : number, depth, values_.size()});
  values_.resize(values_.size() + Columns::in_groups(depth + 1));
  inverse_diagonal_.push_back(0);
  parts_.resize(std::max(parts_.size(), Columns::in_groups(depth)));
  return number;
}

BUBBLESIM_SIMD void BranchedMatrix::factor() {
  for (int k = size() - 1; k >= 0; --k) {
    double* own = values_.data() + dofs_[index(k)].row;
    const std::size_t depth = dofs_[index(k)].depth;
    const double inverse = inverse_diagonal_[index(k)] = 1 / own[depth];
    for (std::size_t i = 0; i < depth; i += 4) four_at(parts_.data() + i) = four_at(own + i) * inverse;
    for (int i = before(k); i >= 0; i = before(i)) {
      const Dof& other = dofs_[index(i)];
      add_multiple(values_.data() + other.row, -parts_[other.depth], own, Columns::in_groups(other.depth + 1));
    }
    std::copy_n(parts_.data(), depth, own);
  }
}

BUBBLESIM_SIMD void BranchedMatrix::solve_upper(double* y) const {
  for (int k = size() - 1; k >= 0; --k) {
    const double* own = values_.data() + dofs_[index(k)].row;
    for (int last = before(k); last >= 0; last = before(first_of_run(last))) {
      const int first = first_of_run(last);
      const double* const from = own + dofs_[index(first)].depth;
      for (int i = first; i <= last; ++i) y[i] -= y[k] * from[i - first];
    }
  }
}

BUBBLESIM_SIMD void BranchedMatrix::solve_upper(Columns& y) const {
  for (int k = size() - 1; k >= 0; --k) {
    const double* own = values_.data() + dofs_[index(k)].row;
    for (int i = before(k); i >= 0; i = before(i)) add_multiple(y[i], -own[dofs_[index(i)].depth], y[k], y.length());
  }
}

BUBBLESIM_SIMD void BranchedMatrix::solve_lower(double* y) const {
  for (int k = 0; k < size(); ++k) {
    const double* own = values_.data() + dofs_[index(k)].row;
    for (int last = before(k); last >= 0; last = before(first_of_run(last))) {
      const int first = first_of_run(last);
      y[k] -= dot(y + first, own + dofs_[index(first)].depth, index(last - first + 1));
    }
  }
}

}  // namespace bubblesim
