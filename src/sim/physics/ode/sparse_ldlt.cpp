// SPDX-License-Identifier: BSD-3-Clause
// Davis, Direct Methods for Sparse Linear Systems, 2006: 4 (left-looking factorisation), 7 (minimum degree).
#include "physics/ode/sparse_ldlt.hpp"

#include <algorithm>

namespace bubblesim {
namespace {

constexpr std::size_t kBits = 64;
constexpr std::uint32_t kNone = 0xffffffff;

double entry(const double* matrix, std::size_t skip, std::uint32_t a, std::uint32_t b) {
  return a < b ? matrix[b * skip + a] : matrix[a * skip + b];
}

template <class Visit>
void for_each_bit(const std::uint64_t* words, std::size_t count, const Visit& visit) {
  for (std::size_t w = 0; w < count; ++w) {
    for (std::uint64_t left = words[w]; left != 0; left &= left - 1) {
      visit(static_cast<std::uint32_t>(w * kBits + static_cast<std::size_t>(__builtin_ctzll(left))));
    }
  }
}

}  // namespace

bool SparseLdlt::factor(const double* matrix, std::size_t skip, const std::vector<std::uint32_t>& chosen) {
  find_order(matrix, skip, chosen);
  return compute(matrix, skip, chosen);
}

/// Finds the order and the rows of each column of L.
void SparseLdlt::find_order(const double* matrix, std::size_t skip, const std::vector<std::uint32_t>& chosen) {
  const std::size_t n = chosen.size();
  const std::size_t words = (n + kBits - 1) / kBits;
  adjacent_.assign(n * words, 0);
  const auto connect = [&](std::size_t i, std::size_t j) { adjacent_[i * words + j / kBits] |= 1ULL << (j % kBits); };
  for (std::size_t i = 0; i < n; ++i) {
    const double* row = matrix + chosen[i] * skip;
    for (std::size_t j = 0; j < i; ++j) {
      if (row[chosen[j]] == 0) continue;
      connect(i, j);
      connect(j, i);
    }
  }
  if (adjacent_ == pattern_ && order_.size() == n) return;  // that of the last substep
  pattern_ = adjacent_;
  degree_.resize(n);
  const auto count = [&](std::size_t i) {
    int degree = 0;
    for (std::size_t w = 0; w < words; ++w) degree += __builtin_popcountll(adjacent_[i * words + w]);
    degree_[i] = degree;
  };
  for (std::size_t i = 0; i < n; ++i) count(i);

  order_.clear();
  place_.assign(n, kNone);
  start_.assign(1, 0);
  row_.clear();
  for (std::size_t done = 0; done < n; ++done) {
    std::uint32_t best = kNone;
    for (std::uint32_t i = 0; i < n; ++i) {
      if (place_[i] == kNone && (best == kNone || degree_[i] < degree_[best])) best = i;
    }
    place_[best] = static_cast<std::uint32_t>(done);
    order_.push_back(best);
    const std::uint64_t* own = &adjacent_[best * words];
    for_each_bit(own, words, [&](std::uint32_t other) {
      row_.push_back(other);
      std::uint64_t* bits = &adjacent_[other * words];
      for (std::size_t w = 0; w < words; ++w) bits[w] |= own[w];
      bits[other / kBits] &= ~(1ULL << (other % kBits));
      bits[best / kBits] &= ~(1ULL << (best % kBits));
      count(other);
    });
    start_.push_back(row_.size());
  }
  for (std::uint32_t& row : row_) row = place_[row];
  for (std::size_t j = 0; j < n; ++j) {
    std::sort(row_.begin() + static_cast<std::ptrdiff_t>(start_[j]),
              row_.begin() + static_cast<std::ptrdiff_t>(start_[j + 1]));
  }
}

bool SparseLdlt::compute(const double* matrix, std::size_t skip, const std::vector<std::uint32_t>& chosen) {
  const std::size_t n = order_.size();
  value_.resize(row_.size());
  diagonal_.resize(n);
  column_.assign(n, 0);
  head_.assign(n, kNone);
  next_.assign(n, kNone);
  at_.assign(start_.begin(), start_.end() - 1);
  // Column k takes part in column j when L has an entry in row j of it: the columns are in a list for the row of their
  // next entry.
  const auto enlist = [&](std::uint32_t k) {
    if (at_[k] == start_[k + 1]) return;
    next_[k] = head_[row_[at_[k]]];
    head_[row_[at_[k]]] = k;
  };
  for (std::uint32_t j = 0; j < n; ++j) {
    const std::uint32_t own = chosen[order_[j]];
    double pivot = entry(matrix, skip, own, own);
    for (std::size_t i = start_[j]; i < start_[j + 1]; ++i) {
      column_[row_[i]] = entry(matrix, skip, chosen[order_[row_[i]]], own);
    }
    for (std::uint32_t k = head_[j]; k != kNone;) {
      const std::uint32_t following = next_[k];
      std::size_t i = at_[k];
      const double part = value_[i] * diagonal_[k];
      pivot -= value_[i] * part;
      for (++i; i < start_[k + 1]; ++i) column_[row_[i]] -= value_[i] * part;
      ++at_[k];
      enlist(k);
      k = following;
    }
    if (!(pivot > 0)) return false;
    diagonal_[j] = pivot;
    for (std::size_t i = start_[j]; i < start_[j + 1]; ++i) value_[i] = column_[row_[i]] / pivot;
    enlist(j);
  }
  return true;
}

void SparseLdlt::solve_lower(double* x) const {
  for (std::size_t j = 0; j < order_.size(); ++j) {
    const double own = x[j];
    if (own == 0) continue;
    for (std::size_t i = start_[j]; i < start_[j + 1]; ++i) x[row_[i]] -= value_[i] * own;
  }
}

void SparseLdlt::solve_upper(double* x) const {
  for (std::size_t j = order_.size(); j-- > 0;) {
    double sum = x[j];
    for (std::size_t i = start_[j]; i < start_[j + 1]; ++i) sum -= value_[i] * x[row_[i]];
    x[j] = sum;
  }
}

}  // namespace bubblesim
