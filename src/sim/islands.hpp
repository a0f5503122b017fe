// SPDX-License-Identifier: BSD-3-Clause
// Which models hang together by contacts, and by how many.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace bubblesim {

/// Sets of models by number that grow together, as a union-find.
class Islands {
 public:
  static constexpr int kNone = -1;  ///< the number of what cannot move

  void clear(std::size_t models) {
    parents_.resize(models);
    std::iota(parents_.begin(), parents_.end(), 0);
    contacts_.assign(models, 0);
    most_ = 0;
  }

  /// Two models, one of which may be kNone, touch in some points.
  void touch(int a, int b, int contacts) {
    if (a == kNone) std::swap(a, b);
    a = root(a);
    if (b != kNone && (b = root(b)) != a) {
      parents_[index(b)] = a;
      contacts_[index(a)] += contacts_[index(b)];
    }
    contacts_[index(a)] += contacts;
    most_ = std::max(most_, contacts_[index(a)]);
  }

  /// Contacts in the island that has the most.
  int most_contacts() const { return most_; }

 private:
  static std::size_t index(int number) { return static_cast<std::size_t>(number); }

  int root(int number) {
    while (parents_[index(number)] != number)
      number = parents_[index(number)] = parents_[index(parents_[index(number)])];
    return number;
  }

  std::vector<int> parents_;
  std::vector<int> contacts_;
  int most_ = 0;
};

}  // namespace bubblesim
