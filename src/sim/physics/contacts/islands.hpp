// SPDX-License-Identifier: BSD-3-Clause
// Contact islands: sets of models that are connected by contacts or attachments, with their number of contacts.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace bubblesim {

/// Sets of models, by index, as a union-find.
class Islands {
 public:
  static constexpr int kNone = -1;  ///< index of static objects
  /// An island with joints and more contacts is too big for the exact solver, whose cost grows with the cube of the
  /// contacts. A model that touches no other moving model may have more, because a robot's wheels creep under the
  /// iterative solver.
  static constexpr int kMaxContacts = 20;
  static constexpr int kMaxContactsAlone = 40;

  /// Starts anew, without islands. Where touch() names a model that is not added, islands are of no use: such models
  /// sleep, wake by the touch, and the search begins again.
  void clear(std::size_t models) {
    parents_.resize(models);
    contacts_.resize(models);
    models_.resize(models);
    jointed_.resize(models);
    by_trees_.resize(models);
    most_ = 0;
  }

  /// Starts an island of one model.
  void add(int model, bool is_jointed) {
    parents_[index(model)] = model;
    contacts_[index(model)] = 0;
    models_[index(model)] = 1;
    jointed_[index(model)] = is_jointed;
    by_trees_[index(model)] = false;
  }

  /// Adds contacts between two models, one of which may be kNone.
  void touch(int a, int b, int contacts) {
    if (a == kNone) std::swap(a, b);
    a = root(a);
    if (b != kNone && (b = root(b)) != a) {
      parents_[index(b)] = a;
      contacts_[index(a)] += contacts_[index(b)];
      models_[index(a)] += models_[index(b)];
      jointed_[index(a)] = jointed_[index(a)] || jointed_[index(b)];
    }
    contacts_[index(a)] += contacts;
    if (jointed_[index(a)]) most_ = std::max(most_, contacts_[index(a)]);
  }

  /// Connects two models by what only the solvers of joints know; one of them may be kNone.
  void join(int a, int b) {
    touch(a, b, 0);
    jointed_[index(root(a == kNone ? b : a))] = true;
  }

  /// The island of a model.
  int of(int model) { return root(model); }
  /// Whether a model of the island has joints.
  bool is_jointed(int island) const { return jointed_[index(island)]; }
  /// Whether an island is solved by trees, not by ODE. Set when its contacts are known.
  bool is_by_trees(int island) const { return by_trees_[index(island)]; }
  void set_by_trees(int island, bool by_trees) { by_trees_[index(island)] = by_trees; }
  int contacts(int island) const { return contacts_[index(island)]; }
  void set_contacts(int island, int contacts) { contacts_[index(island)] = contacts; }
  /// Maximum number of contacts in an island for the exact solver.
  int limit(int island) const { return models_[index(island)] == 1 ? kMaxContactsAlone : kMaxContacts; }
  /// Whether an island with joints is too big for the exact solver.
  bool is_beyond_limit(int island) const { return is_jointed(island) && contacts(island) > limit(island); }
  /// Whether an island with joints may be too big for the exact solver.
  bool may_be_beyond_limit() const { return most_ > kMaxContacts; }

 private:
  static std::size_t index(int number) { return static_cast<std::size_t>(number); }

  int root(int number) {
    while (parents_[index(number)] != number)
      number = parents_[index(number)] = parents_[index(parents_[index(number)])];
    return number;
  }

  std::vector<int> parents_;
  std::vector<int> contacts_;
  std::vector<int> models_;
  std::vector<bool> jointed_;
  std::vector<bool> by_trees_;
  int most_ = 0;
};

}  // namespace bubblesim
