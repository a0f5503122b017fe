// SPDX-License-Identifier: BSD-3-Clause
// One substep of all islands, each with the solver that suits it: see docs/adr/0024.
#pragma once

#include <vector>

#include "physics/contacts/contact_solver.hpp"
#include "physics/contacts/friction_iteration.hpp"
#include "physics/contacts/substep.hpp"
#include "physics/contacts/tree_solver.hpp"

namespace bubblesim {

/// Its vectors are working memory.
class IslandSolvers {
 public:
  /// Solves the islands that trees solve, and moves their bodies.
  void solve_trees(Substep& substep);
  /// Likewise the others, with the contacts that are joints of ODE.
  void solve_rest(Substep& substep);

 private:
  /// A pair of shapes in an island without joints.
  struct FreePair {
    int island = Islands::kNone;
    const FoundPair* pair = nullptr;
    const RememberedPair* remembered = nullptr;  // null when the shapes did not touch before
  };

  void solve_without_trees(Substep& substep);
  void solve_free_contacts(Substep& substep);
  bool step_exactly(Substep& substep);
  bool step_by_islands(Substep& substep, bool iterate_all);

  std::vector<FreePair> free_pairs_;
  ContactSolver contact_solver_;          // of islands without joints
  FrictionIteration friction_iteration_;  // of islands with joints
  TreeSolver tree_solver_;                // likewise, where the scene selects it
  std::vector<dBodyID> by_trees_;         // the bodies that the last has moved
  std::vector<KeptBody> bodies_before_;   // of the last exact step
};

}  // namespace bubblesim
