// SPDX-License-Identifier: BSD-3-Clause
// Stacks: bodies whose contacts with each other form a tree. Sequential impulses pass a load on from body to body, and
// let a tower sway for hundreds of sweeps; here all contacts are solved at once, as long as they press and stick.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "physics/contacts/solved_island.hpp"

namespace bubblesim {

/// Its vectors are working memory.
class StackSolver {
 public:
  /// Finds by how much the impulses have to change, one linear equation for contacts that press and stick. Returns
  /// false if bodies touch in a loop, or if contacts would pull or slide then.
  bool solve(const SolvedIsland& island);
  /// N s, of the normal and the tangents of a point.
  const std::array<double, 3>& change(std::size_t point) const { return changes_[point]; }

 private:
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  /// What a point does in the solution.
  enum class Contact { kOpen, kSlides, kSticks };
  /// How many rows of a point are unknown: none, that of the normal, or all.
  static std::size_t solved_rows(Contact contact);

  /// A body with the equation of its motion: own * motion + above^T * (that of the body above) = push.
  struct Node {
    int above = 0;  // the body through which it is eliminated; 0: none
    Matrix6 own;
    Matrix6 to_above;
    SpatialVector push;
    SpatialVector motion;  // its change: m/s of the centre of mass, and rad/s
  };

  /// Makes the bodies a tree; returns false for loops.
  bool arrange(const SolvedIsland& island);
  /// Contacts go on as they are.
  void assume(const SolvedIsland& island);
  void assemble(const SolvedIsland& island);
  void eliminate();
  /// Sets the changes of the impulses; returns false if contacts have to do something else than was assumed, which they
  /// do from now on.
  bool judge(const SolvedIsland& island);
  SpatialVector relative(const SolvedPair& pair) const;

  std::vector<Node> nodes_;                     // by body
  std::vector<int> order_;                      // of elimination
  std::vector<char> seen_;                      // of each body, whether it is in the order
  std::vector<std::vector<int>> neighbours_;    // of each body
  std::vector<Contact> contacts_;               // of each point
  std::vector<std::array<double, 3>> missing_;  // of each point: m/s, by which rows miss their targets
  std::vector<std::array<double, 3>> changes_;  // of each point
};

}  // namespace bubblesim
