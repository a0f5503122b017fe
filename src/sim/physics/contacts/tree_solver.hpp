// SPDX-License-Identifier: BSD-3-Clause
// Islands with joints, solved as trees in generalised coordinates together with their contacts: see docs/adr/0050.
#pragma once

#include <cstddef>
#include <vector>

#include "physics/contacts/substep.hpp"
#include "physics/contacts/tree_model.hpp"

namespace bubblesim {

/// Its vectors are working memory.
class TreeSolver {
 public:
  /// Marks the islands that solve() will solve: those with joints whose models trees know.
  static void choose(Substep& substep);
  /// Solves these islands and moves their bodies. Those whose models would turn too far are marked for ODE, unchanged.
  void solve(Substep& substep);

 private:
  struct IslandPair {
    int island = Islands::kNone;
    const FoundPair* pair = nullptr;
    const RememberedPair* remembered = nullptr;
  };
  struct IslandModel {
    int island = Islands::kNone;
    std::size_t turn = 0;  // among the models that are awake
    TreeModel* model = nullptr;
  };
  struct PointRows {
    FoundContact* point = nullptr;
    int normal = 0;
    int spin = -1;  // of its resistances to rolling (2) and spinning; -1: none
    Four axes[3];   // the normal and the directions of friction
  };

  void gather(Substep& substep);
  void solve_island(Substep& substep);
  void add_hold(const Hold& hold, double step);
  void add_pair(const IslandPair& pair, Substep& substep);
  void add_point(const TreeBody& a, const TreeBody& b, const FoundPair& pair, FoundContact& found,
                 const ExpectedContact& start, double step);
  void report_forces(double step);
  TreeBody body_of(const Collider& collider, const Substep& substep) const;

  std::vector<IslandModel> models_;  // that are awake, island by island
  std::vector<IslandPair> pairs_;    // island by island
  std::size_t next_model_ = 0;
  std::size_t next_pair_ = 0;
  std::vector<PointRows> points_;
  ConstraintRows rows_;
};

}  // namespace bubblesim
