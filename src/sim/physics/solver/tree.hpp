// SPDX-License-Identifier: BSD-3-Clause
// A tree of rigid links in generalised coordinates: topology, kinematics, dynamics.
//
// After R. Featherstone, "Rigid Body Dynamics Algorithms", 2008: articulated bodies (chapter 7). All vectors have world
// axes; moments and positions refer to the origin of the tree, the first link's centre of mass.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "bubblesim/math.hpp"
#include "physics/solver/articulated_inertia.hpp"
#include "physics/solver/branched_factors.hpp"
#include "physics/solver/directions.hpp"

namespace bubblesim {

/// How a link moves in its parent.
enum class TreeMotion { kFree, kFixed, kTurns, kSlides, kScrews, kTwoAxes, kBall };

struct TreeLink {
  int parent = -1;  ///< a link that was added before; -1: the world
  TreeMotion motion = TreeMotion::kFree;
  Vector3 axis{0, 0, 1};                  ///< unit length, in the joint's frame
  Vector3 axis2{0, 0, 1};                 ///< of kTwoAxes: fixed in the child, at the angle 0
  double lead = 0;                        ///< m/rad, of kScrews
  Pose in_parent;                         ///< the joint's frame in the parent, whose origin is its centre of mass
  Pose in_child;                          ///< likewise in this link
  double mass = 1;                        ///< kg, at first
  Matrix3 inertia = Matrix3::Identity();  ///< kg m^2, about the centre of mass, in the link's axes
};

/// The coordinate of a joint.
struct TreeJointState {
  Quaternion turn;   ///< of the child in the joint; of kFree in the world; of kTwoAxes about the first axis
  Quaternion turn2;  ///< of kTwoAxes about the second axis
  double slide = 0;  ///< m
  Vector3 place;     ///< m, of kFree: the centre of mass in the world
};

/// Where a link is, and how it moves.
struct TreeLinkState {
  Four place = {};           ///< m, the centre of mass in the world
  Four turn = {0, 0, 0, 1};  ///< of the link in the world: x, y, z, w
  SpatialLanes velocity;     ///< rad/s, and of the centre of mass in m/s
};

class Tree {
 public:
  /// Adds a link; returns its number.
  int add(const TreeLink& link);
  void set_inertia(int link, double mass, const Matrix3& inertia);
  double mass(int link) const { return bodies_[index(link)].mass; }

  int links() const { return static_cast<int>(links_.size()); }
  int parent(int link) const { return numbers_[index(link)].parent; }
  int dofs() const { return static_cast<int>(dofs_.size()); }
  int first_dof(int link) const { return numbers_[index(link)].first; }
  int dof_count(int link) const { return numbers_[index(link)].count; }
  /// The last degree of freedom that moves a link; -1: none.
  int last_dof(int link) const { return links_[index(link)].last_dof; }
  /// The degree of freedom before another on the way to the world; -1: none.
  int before(int dof) const { return factors_.before(dof); }

  /// Takes places, joints and rates from the states of the links. Joints and rates drop what the joints do not allow.
  /// Computes the velocities from the rates.
  void read(const std::vector<TreeLinkState>& states);
  TreeJointState& joint(int link) { return joints_[index(link)]; }
  Eigen::VectorXd& rates() { return rates_; }  ///< rad/s or m/s; of kFree: angular, then linear velocity in the world
  const Eigen::VectorXd& rates() const { return rates_; }

  /// Computes places from the joints, and the velocities from the rates.
  void place();
  /// Computes the velocities of the links from rates, at the present place.
  void set_velocities(const Eigen::VectorXd& rates);
  Pose pose(int link) const {
    const Body& body = bodies_[index(link)];
    return {origin_ + vector_of(body.centre), quaternion_of(body)};
  }
  Twist velocity(int link) const {
    const Body& body = bodies_[index(link)];
    return {vector_of(body.velocity.at(body.centre)), vector_of(body.velocity.angular)};
  }
  /// Of a point of the world that moves with a link, while the rates are constant, m/s^2. After push().
  Vector3 acceleration(int link, const Vector3& point) const;
  const Vector3& origin() const { return origin_; }

  /// Computes the inertias at the present place, of links and articulated, with `added` to the mass matrix by degree of
  /// freedom, kg or kg m^2.
  void weigh(const Eigen::VectorXd& added);
  /// Adds to the wrenches on links, about their centres of mass in N m and N, what takes their velocities in a substep
  /// to those that the joints allow.
  void add_impulses(const std::vector<TreeLinkState>& states, double step, std::vector<SpatialLanes>& wrenches) const;
  /// Changes the rates by a substep: (M + added) du = step (forces - bias), where the bias is what rates and wrenches
  /// on links (about their centres of mass) need, at the mean of the rates before and after, which makes it of second
  /// order. After weigh(), and set_velocities() of the present rates.
  void push(double step, const std::vector<SpatialLanes>& wrenches, const Eigen::VectorXd& forces);

  /// Computes the factors of the mass matrix plus `added`, for rows of constraints. After weigh().
  void factor();
  /// After factor().
  const BranchedFactors& factors() const { return factors_; }
  /// Takes forces with their moments about a point, times `sign`, to the origin, and adds what they do along the
  /// degrees of freedom that move a link: to one row for each, `width` numbers apart, which has a place for all degrees
  /// of freedom. After factor().
  void project(int link, const Vector3& point, double sign, SpatialLanes* forces, int count, double* rows,
               std::size_t width) const;

  /// Moves the joints by the rates.
  void move(double step);
  double kinetic_energy() const;

  /// The link of kFree that carries a link; -1: the world carries it.
  int free_root(int link) const { return links_[index(link)].free_root; }
  /// The momenta of links, N s and N m s about the origin, after a step with their velocities before it and the
  /// wrenches on them, if they were not jointed.
  void release(const std::vector<TreeLinkState>& states, const std::vector<SpatialLanes>& wrenches, double step,
               std::vector<SpatialLanes>& momenta) const;
  /// Of a link, at the present place and velocity.
  SpatialLanes momentum(int link) const {
    const Body& body = bodies_[index(link)];
    return body.momentum(body.velocity.at(body.centre), body.velocity.angular);
  }
  /// Changes the velocities of links of kFree, and with them that of all that they carry as if it were rigid, until
  /// together they have the momenta given for these links. The rates keep their values.
  void set_momenta(const std::vector<SpatialLanes>& momenta);

 private:
  struct Placed {
    TreeLink link;
    int last_dof = -1;
    int free_root = -1;
    // In the parent, and in the link:
    Four axis = {};
    Four in_parent = {};
    Four in_child = {};
    // Of a link that turns about one axis, its orientation in its parent after 0 and half a turn: with cosine and sine
    // of half an angle they add up to the one there.
    Four straight = {};
    Four turned = {};
  };
  struct Body {
    Four orientation = {0, 0, 0, 1};  // x, y, z, w
    MatrixLanes axes;                 // of this orientation
    MatrixLanes inertia;              // likewise: world axes, about the centre
    double mass = 0;
    Four centre = {};  // from the origin
    Four anchor = {};  // of its joint, likewise
    SpatialLanes velocity;
    // Of push():
    SpatialLanes acceleration;  // the derivative of `velocity` while the rates are constant
    SpatialLanes needs;         // for this acceleration, with what its children need
    SpatialLanes change;        // of the velocity per second, by that of the rates

    /// About the origin; `pace` is the velocity of the centre of mass.
    BUBBLESIM_INLINE SpatialLanes momentum(const Four& pace, const Four& spin) const {
      const Four linear = pace * mass;
      return {cross(centre, linear) + inertia * spin, linear};
    }
  };

  static std::size_t index(int number) { return static_cast<std::size_t>(number); }
  /// Of a TreeLink or its LinkDofs.
  template <class Link>
  const Body& parent_of(const Link& link) const {
    return link.parent < 0 ? world_ : bodies_[index(link.parent)];
  }
  static Quaternion quaternion_of(const Body& body) {
    const Four& turn = body.orientation;
    return {turn[3], turn[0], turn[1], turn[2]};
  }
  void set_origin(const Four& origin);
  void turn(int link, const Four& orientation);
  void read_joint(int link, const std::vector<TreeLinkState>& states);
  void place_joint(int link);
  void set_velocity(int link, const double* rates);
  void accelerate(int link, const double* rates);
  void find_need(int link, const double* rates, const SpatialLanes& wrench);
  void gather_needs(const double* forces);
  void project(const SpatialLanes& force, int first, int count, double* along) const;
  void find_change_of_base();
  void find_change(int link);
  void set_momentum(int root, const std::vector<SpatialLanes>& momenta);

  std::vector<Placed> links_;
  std::vector<LinkDofs> numbers_;
  std::vector<TreeJointState> joints_;
  std::vector<Body> bodies_;
  Body world_;
  std::vector<ArticulatedInertia> inertias_;
  std::vector<TreeDof> dofs_;
  Eigen::VectorXd rates_, middle_;
  Eigen::VectorXd change_;  // of the rates per second; before, the forces that are left for it
  Vector3 origin_;
  // Consecutive degrees of freedom, beside those of the base, whose directions are taken one by one: as of wheels.
  static constexpr int kShortRun = 4;
  bool has_long_runs_ = false;
  Directions directions_;  // those of the degrees of freedom, once more, for long runs
  BranchedFactors factors_;
};

}  // namespace bubblesim
