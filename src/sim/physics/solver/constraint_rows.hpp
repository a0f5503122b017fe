// SPDX-License-Identifier: BSD-3-Clause
// Constraints on the velocities of trees: their rows, and the cone problem of their impulses.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "bubblesim/math.hpp"
#include "physics/solver/columns.hpp"
#include "physics/solver/cone_problem.hpp"
#include "physics/solver/impact_chain.hpp"
#include "physics/solver/tree.hpp"

namespace bubblesim {

/// A link of a tree; without a tree, the world.
struct TreeBody {
  Tree* tree = nullptr;
  int link = 0;
};

class ConstraintRows {
 public:
  static constexpr int kMostAtOnce = 3;

  void clear();
  int count() const { return static_cast<int>(rows_.size()); }

  /// A force along `direction` at a point, on the first body, and the opposite on the second. Returns its number.
  int add_force(const TreeBody& first, const TreeBody& second, const Vector3& point, const Vector3& direction);
  /// Likewise rows for as many forces with moments about the point, `kMostAtOnce` at most; returns the number of the
  /// first.
  int add_forces(const TreeBody& first, const TreeBody& second, const Vector3& point, const SpatialLanes* forces,
                 int count);
  int add_torque(const TreeBody& first, const TreeBody& second, const Vector3& axis);
  /// Adds a torque, likewise, to the row that was added last.
  void add_torque_to_last(const TreeBody& first, const TreeBody& second, const Vector3& axis);
  int add_dof(Tree& tree, int dof);
  /// What the velocity of a row is to be, m/s or rad/s, and how much of it an impulse lets through, 1/kg; start: N s.
  void set(int row, double target, double softness, double start);
  /// Marks a row of a contact: other rows may hold the same bodies.
  void set_of_contact(int row);
  /// Keeps the impulse of a row from `lower` to `upper`, N s or N m s.
  void bound(int row, double lower, double upper);
  /// Keeps the impulse of a row, or of two together, within `mu` times that of another row.
  void bound_by(int normal, double mu, int row, int size);
  /// Lets a contact bounce; its `contact` is the row of its normal, whose target is that of this impact alone.
  void add_impact(const Impact& impact) { impacts_.add(impact); }

  /// Lets a row keep two parts together: `error`, m or rad, is how far apart they are along it; `drift` how much
  /// further a substep would take them although their velocities agree.
  void hold(int row, double error, double step, double drift = 0);

  /// Finds the impulses and changes the rates of the trees, which are weighed.
  ConeResult solve();
  double impulse(int row) const { return problem_.x[row]; }
  /// Adds the impulses of forces and torques, which act between links or on the world, to the momenta of a tree's
  /// links, about the origin that it had when the rows were added.
  void add_impulses(const Tree& tree, std::vector<SpatialLanes>& links) const;

 private:
  struct Row {
    double target = 0;
    double softness = 0;
    double start = 0;
    double singular = 0;  // least part of the diagonal element that is added to it
  };
  /// What consecutive rows do to a link per impulse.
  struct Action {
    const Tree* tree;
    int link;
    int row;  // the first
    int count;
    std::array<SpatialLanes, kMostAtOnce> forces;  // about the tree's origin
  };
  /// The rows that act on one tree; those that also act on another one are in both.
  struct RowsOfTree {
    Tree* tree = nullptr;
    std::size_t width = 0;      // of its degrees of freedom, in groups of four
    std::vector<int> rows;      // their numbers
    std::vector<double> given;  // J: row by row of this width; 0 beside the ways to the world
    Columns solved;             // J L^-1
  };

  void gather(RowsOfTree& own);
  /// Starts from the impulses of impacts that travel through several bodies.
  void pass_impacts_on();
  void leave_out(int row);
  void apply(RowsOfTree& own);
  /// Whether the only tree has all rows.
  bool is_of_one_tree() const { return used_ == 1 && trees_.front().rows.size() == rows_.size(); }
  int add_rows(int count);
  /// Adds forces with moments about a point to the last rows.
  void act(const TreeBody& first, const TreeBody& second, const Vector3& point, const SpatialLanes* forces, int count);
  RowsOfTree& rows_of(Tree& tree);
  /// The values of the last rows in a tree, which are 0 at first.
  double* values(RowsOfTree& own, int rows) const;
  void act(const TreeBody& body, const Vector3& point, double sign, const SpatialLanes* forces, int count);

  std::vector<Row> rows_;
  std::vector<Action> actions_;    // of forces and torques on links
  std::vector<RowsOfTree> trees_;  // the first `used_` of them; the others keep their memory
  std::size_t used_ = 0;
  ImpactChain impacts_;
  ConeProblem problem_;
  ConeSolver solver_;
  Columns square_;
  std::vector<double> sums_;      // by row or degree of freedom of a tree
  std::vector<double> impulses_;  // of the rows of a tree
};

}  // namespace bubblesim
