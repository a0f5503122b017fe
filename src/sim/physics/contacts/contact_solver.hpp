// SPDX-License-Identifier: BSD-3-Clause
// Contacts of bodies without joints, by sequential impulses that start from those of the last substep: see
// docs/adr/0024.
#pragma once

#include <cstddef>
#include <vector>

#include "bubblesim/math.hpp"
#include "physics/contacts/contact_memory.hpp"
#include "physics/contacts/found_contacts.hpp"
#include "physics/contacts/solved_island.hpp"
#include "physics/contacts/stack_solver.hpp"
#include "physics/solver/impact_chain.hpp"

namespace bubblesim {

struct Link;

/// Solves islands one by one; its vectors are working memory.
class ContactSolver {
 public:
  /// Starts an island.
  void clear();
  /// The number of a link's body; adds it as it will move in the substep without contacts. 0 is the static world.
  int number_of(const Link& link, const Vector3& gravity, double step);
  /// Starts a pair of bodies, or of a body and the static world (0), that touch at and around a place.
  void add_pair(int a, int b, const Vector3& place, double height);
  /// Adds a point to the last pair. Starts from what is expected of it.
  void add_point(const FoundContact& found, std::size_t index, const ExpectedContact& start, double step);
  /// Finds the impulses, and applies them as forces in the coming substep. Sets FoundContact::force.
  void solve(std::vector<FoundContact>& points, double step);

 private:
  /// By how much a sweep changed the solution.
  struct Change {
    double velocity = 0;  // m/s, the greatest
    double square = 0;    // N^2 s^2, of the impulses
  };

  void add_body(const Link& link, const Vector3& gravity, double step);
  /// By how much an impulse along the normal of the other point raises the separation of a point, 1/kg.
  double effect(const SolvedPair& pair, const SolvedPoint& point, const SolvedPair& other_pair,
                const SolvedPoint& other) const;
  /// Starts from the impulses of impacts that travel through several bodies. The pairs are in the order of their
  /// points.
  void pass_impacts_on();
  /// Solves each point once.
  Change sweep();
  /// Solves a stack at once. Returns false if it is none, or its contacts do not stay as they are.
  bool solve_stack();
  /// Continues in the direction of the sweeps before (nonsmooth nonlinear conjugate gradients: Silcowitz, Niebe and
  /// Erleben, The Visual Computer 26, 2010).
  void accelerate(double part);
  /// Adds the resistances to rolling and spinning of a point.
  void add_spin(const SolvedPair& pair, PairMotion& pushed, SolvedPoint& point, const dSurfaceParameters& surface,
                const Vector3& expected);
  /// Changes the impulse of each row by `more_of(point, row)` in N s, and the motion of the bodies with it.
  template <class MoreOf>
  void change_impulses(const MoreOf& more_of);
  /// Gives the bodies the impulses of the pair.
  void give(const SolvedPair& pair, const SpatialVector& given);
  void push(const SolvedPair& pair, const SpatialVector& given, double step) const;
  Vector3 lever(int body, const Vector3& place) const;

  std::vector<int> numbers_;  // of bodies, by Link::number; 0: not in the island
  SolvedIsland island_;
  ImpactChain impacts_;
  StackSolver stack_solver_;
};

}  // namespace bubblesim
