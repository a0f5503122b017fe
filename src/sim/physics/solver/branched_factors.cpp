// SPDX-License-Identifier: BSD-3-Clause
#include "physics/solver/branched_factors.hpp"

#include "scene/simd.hpp"

namespace bubblesim {

int BranchedFactors::add(int before) {
  const int number = size();
  const bool continues = before >= 0 && before == number - 1;
  const std::size_t depth = before < 0 ? 0 : dofs_[index(before)].depth + 1;
  dofs_.push_back({before, continues ? dofs_[index(before)].run : number, depth, values_.size()});
  values_.resize(values_.size() + depth);
  inverse_diagonal_.push_back(0);
  return number;
}

BUBBLESIM_SIMD void BranchedFactors::solve_upper(Columns& y) const {
  for (int k = size() - 1; k >= 0; --k) {
    const double* own = values_.data() + dofs_[index(k)].row;
    for (int i = before(k); i >= 0; i = before(i)) add_multiple(y[i], -own[dofs_[index(i)].depth], y[k], y.length());
  }
}

BUBBLESIM_SIMD void BranchedFactors::solve_lower(double* y) const {
  for (int k = 0; k < size(); ++k) {
    const double* own = values_.data() + dofs_[index(k)].row;
    for (int last = before(k); last >= 0; last = before(first_of_run(last))) {
      const int first = first_of_run(last);
      y[k] -= dot(y + first, own + dofs_[index(first)].depth, index(last - first + 1));
    }
  }
}

}  // namespace bubblesim
