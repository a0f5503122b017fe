// SPDX-License-Identifier: BSD-3-Clause
// Friction limits that agree with the normal forces of the same substep: see docs/adr/0024.
#pragma once

#include <vector>

#include "physics/contacts/substep.hpp"
#include "physics/ode/body_state.hpp"

namespace bubblesim {

/// A body as it was before a step.
struct KeptBody {
  dBodyID body;
  int island;
  BodyNumbers numbers;
};

/// Solves those islands again in which the friction of ODE's exact solution does not follow from its normal forces. The
/// normal force that limits the friction of a pair of shapes is a fixed point of "limit by it, solve"; Anderson's
/// mixing of the last two solutions finds it (D. G. Anderson, "Iterative procedures for nonlinear integral equations",
/// 1965). Its vectors are working memory.
class FrictionIteration {
 public:
  /// Call after the exact solver; `before` are the bodies before it.
  void run(Substep& substep, const std::vector<KeptBody>& before);

 private:
  struct Pair {
    const FoundPair* found = nullptr;
    int island = 0;
    double load = 0;     // N, sum of the normal forces that act
    double relied = 0;   // N, sum of those that the friction relies on
    double missing = 0;  // N, `load` less `relied`
    double relied_before = 0;
    double missing_before = 0;
  };
  struct Island {
    bool again = false;  // to be solved again
    bool disagrees = false;
    double load = 0;    // N
    double change = 0;  // N^2, product of what is missing and its change
    double square = 0;  // N^2, of the change
  };

  void collect(Substep& substep);
  /// Compares friction and normal forces of the last solution; returns whether an island must be solved again.
  bool judge(FoundContacts& found);
  /// Sets the limits of the next solution, and puts the bodies back.
  void limit(FoundContacts& found, const std::vector<KeptBody>& before);
  /// Puts the bodies of the islands that are solved again where they were before the solver.
  void put_back(const std::vector<KeptBody>& before) const;
  /// Returns whether there was a solution.
  bool solve(Substep& substep, const std::vector<KeptBody>& before);

  bool is_again(int island) const { return islands_[static_cast<std::size_t>(island)].again; }
  Island& island_of(const Pair& pair) { return islands_[static_cast<std::size_t>(pair.island)]; }

  int solutions_ = 0;
  std::vector<Pair> pairs_;
  std::vector<Island> islands_;
  std::vector<dBodyID> others_;
};

}  // namespace bubblesim
