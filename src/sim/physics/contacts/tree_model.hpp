// SPDX-License-Identifier: BSD-3-Clause
// A model as trees of links in generalised coordinates, with the rows of its joints.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "bubblesim/math.hpp"
#include "physics/parts/placed_model.hpp"
#include "physics/solver/constraint_rows.hpp"
#include "physics/solver/tree.hpp"

namespace bubblesim {

/// How a joint of a type of SDFormat moves its child.
TreeMotion motion_of(const std::string& type);

class TreeModel {
 public:
  explicit TreeModel(const PlacedModel& model);

  /// Whether all joints of a model are of kinds that trees know.
  static bool knows_joints_of(const PlacedModel& model);
  /// Whether the present parts of the model are known: not sensors in joints that close a loop.
  bool knows_parts() const;

  /// Whether a link turns so far in a substep that the forces of its rotation, which are those at the mean of the rates
  /// before and after, would make energy. Wheels, and other links that turn about one axis and carry nothing, never do.
  bool turns_too_far(double step) const;
  /// Likewise at the rates that ConstraintRows::solve() has found.
  bool would_turn_too_far(double step);

  TreeBody body(const Link& link);

  /// Takes the state from ODE's bodies, and the rates to those at the end of the substep without motors, stops and
  /// contacts.
  void begin(const Vector3& gravity, double step);
  /// Adds the rows of motors, friction, stops and closed loops.
  void add_rows(ConstraintRows& rows, double step);
  /// Reports the efforts of motors, moves the bodies, and clears their forces.
  void end(const ConstraintRows& rows, double step);

 private:
  struct Axis {
    std::size_t joint;  // of the model
    int number;         // of the axis in its joint
    int dof;            // -1: of a joint that closes a loop
    AxisForces forces;  // in this substep
  };
  struct TreeJoint {
    std::size_t joint;  // of the model
    int child;          // in the tree
  };
  struct MotorRow {
    MotorMeter* meter;
    int row;
  };

  void add_link(std::size_t joint, int parent);
  void take_inertia(std::size_t number);
  void take_states(const Vector3& gravity);
  void note_what_swings();
  /// `rate_of`: rad/s, of a link of the tree.
  template <class RateOf>
  bool any_turns_too_far(double step, const RateOf& rate_of) const;
  void add_axis_rows(const Axis& axis, ConstraintRows& rows, double step);
  int add_axis_row(const Axis& axis, ConstraintRows& rows);
  void add_stops(const Axis& axis, ConstraintRows& rows, double step);
  void close_loop(std::size_t joint, ConstraintRows& rows, double step);
  void couple(std::size_t gearbox, ConstraintRows& rows, double step);
  void add_planar_motor(ConstraintRows& rows, double step);
  void move(const ConstraintRows& rows, double step);
  void coast(double step);
  void keep_momenta(const Vector3& origin_before);
  void report_reactions();
  TreeBody body_of(ObjectId link);
  TreeBody body_named(const std::string& name);
  const Link& link_of(ObjectId link) const;
  std::size_t place_of(ObjectId link) const;

  const PlacedModel& model_;
  Tree tree_;
  std::vector<int> numbers_;        // in the tree, by link of the model
  std::vector<const Link*> parts_;  // the reverse
  std::vector<int> swinging_;       // links of the tree that carry others, or turn about more than one axis
  double most_turn_ = 0;            // rad in a substep, of these links
  std::vector<Axis> axes_;
  std::vector<TreeJoint> tree_joints_;
  std::vector<std::size_t> gearboxes_;
  std::vector<std::size_t> loops_;  // the other joints
  std::vector<MotorRow> motors_;
  std::vector<TreeLinkState> states_;
  std::vector<SpatialLanes> wrenches_;
  bool floats_ = false;              // whether it has links that the world does not carry
  bool keeps_momenta_ = false;       // for floating roots, and for force-torque sensors
  std::vector<SpatialLanes> loose_;  // the links' momenta at the end of the substep if they were not jointed
  Eigen::VectorXd forces_, added_;
};

}  // namespace bubblesim
