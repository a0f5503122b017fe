// SPDX-License-Identifier: BSD-3-Clause
// Constraints on the velocities of trees: their rows, and the cone problem of their impulses.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "bubblesim/math.hpp"
#include "physics/solver/cone_problem.hpp"
#include "physics/solver/tree.hpp"

namespace bubblesim {

/// A link of a tree; without a tree, the world.
struct TreeBody {
  Tree* tree = nullptr;
  int link = 0;
};

class ConstraintRows {
 public:
  void clear();
  int count() const { return static_cast<int>(rows_.size()); }

  /// A force along `direction` at a point, on the first body, and the opposite on the second. Returns its number.
  int add_force(const TreeBody& first, const TreeBody& second, const Vector3& point, const Vector3& direction);
  int add_torque(const TreeBody& first, const TreeBody& second, const Vector3& axis);
  int add_dof(Tree& tree, int dof);
  /// What the velocity of a row is to be, m/s or rad/s, and how much of it an impulse lets through, 1/kg; start: N s.
  void set(int row, double target, double softness, double start);
  void bound(const ConeBlock& block) { problem_.blocks.push_back(block); }

  /// The present velocity of a row: of the first body relative to the second.
  double velocity(int row) const;
  /// Finds the impulses and changes the rates of the trees, which are factored.
  ConeResult solve();
  double impulse(int row) const { return problem_.x[row]; }

 private:
  /// The part of a row in one tree; the values by degree of freedom are 0 beside the two ways to the world.
  struct Side {
    Tree* tree = nullptr;
    std::array<int, 2> leaves{-1, -1};
    std::size_t given = 0;   // J, in values_
    std::size_t solved = 0;  // L^-T J
  };
  struct Row {
    std::array<Side, 2> sides;
    double target = 0;
    double softness = 0;
    double start = 0;
  };

  int add(const TreeBody& first, const TreeBody& second, const Vector3& turn, const Vector3& push,
          const Vector3& point);
  Side& side_of(Row& row, Tree* tree);
  void add_way(Row& row, const TreeBody& body, const Vector3& turn, const Vector3& push, const Vector3& point,
               double sign);
  double product(const Side& a, const Side& b) const;

  std::vector<Row> rows_;
  std::vector<double> values_;
  ConeProblem problem_;
  ConeSolver solver_;
  std::vector<double> change_;
};

}  // namespace bubblesim
