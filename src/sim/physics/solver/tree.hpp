// SPDX-License-Identifier: BSD-3-Clause
// A tree of rigid links in generalised coordinates: topology, kinematics, mass matrix and its factors.
//
// After R. Featherstone, "Rigid Body Dynamics Algorithms", 2008: composite rigid bodies (chapter 6), recursive
// Newton-Euler (chapter 5). All vectors have world axes; moments and positions refer to the origin of the tree, the
// first link's centre of mass.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "bubblesim/math.hpp"
#include "bubblesim/wrench.hpp"
#include "physics/solver/branched_matrix.hpp"
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
  double mass = 1;                        ///< kg
  Matrix3 inertia = Matrix3::Identity();  ///< kg m^2, about the centre of mass, in the link's axes
};

/// The coordinate of a joint.
struct TreeJointState {
  Quaternion turn;   ///< of the child in the joint; of kFree in the world; of kTwoAxes about the first axis
  Quaternion turn2;  ///< of kTwoAxes about the second axis
  double slide = 0;  ///< m
  Vector3 place;     ///< m, of kFree: the centre of mass in the world
};

/// Of links that hang together.
struct TreeMomentum {
  Vector3 linear;   ///< N s
  Vector3 angular;  ///< N m s, about the origin of the tree
};

class Tree {
 public:
  /// Adds a link; returns its number.
  int add(const TreeLink& link);
  void set_inertia(int link, double mass, const Matrix3& inertia);
  double mass(int link) const { return links_[index(link)].link.mass; }

  int links() const { return static_cast<int>(links_.size()); }
  int parent(int link) const { return links_[index(link)].link.parent; }
  int dofs() const { return static_cast<int>(columns_.size()); }
  int first_dof(int link) const { return links_[index(link)].first_dof; }
  int dof_count(int link) const { return links_[index(link)].dof_count; }
  /// The last degree of freedom that moves a link; -1: none.
  int last_dof(int link) const { return links_[index(link)].last_dof; }
  /// The degree of freedom before another on the way to the world; -1: none.
  int before(int dof) const { return mass_matrix_.before(dof); }

  /// Takes places, joints and rates from poses and velocities of the centres of mass, by link. Joints and rates drop
  /// what the joints do not allow.
  void read(const std::vector<Pose>& poses, const std::vector<Twist>& velocities);
  TreeJointState& joint(int link) { return joints_[index(link)]; }
  Eigen::VectorXd& rates() { return rates_; }  ///< rad/s or m/s; of kFree: angular, then linear velocity in the world
  const Eigen::VectorXd& rates() const { return rates_; }

  /// Computes places from the joints.
  void place();
  /// Computes the velocities of the links from rates, at the present place.
  void set_velocities(const Eigen::VectorXd& rates);
  Pose pose(int link) const;
  Twist velocity(int link) const {
    const Body& body = bodies_[index(link)];
    return {body.velocity.at(body.centre), body.velocity.turn};
  }
  /// Of a point of the world that moves with a link, while the rates are constant, m/s^2. After push().
  Vector3 acceleration(int link, const Vector3& point) const;
  const Vector3& origin() const { return origin_; }
  /// Adds to the degrees of freedom that move a link, from `forces` of all, what a force and its moment about the
  /// origin do along them.
  void project(int link, const Vector3& moment, const Vector3& force, double* forces) const;

  /// Computes the mass matrix at the present place.
  void compute_mass();
  /// Of a link about its centre of mass in world axes, kg m^2. After compute_mass().
  const Matrix3& inertia(int link) const { return bodies_[index(link)].inertia; }
  /// Computes and factors the mass matrix plus `added`, kg or kg m^2 by degree of freedom, at the present place.
  void factor(const Eigen::VectorXd& added);
  const BranchedMatrix& mass_matrix() const { return mass_matrix_; }

  /// The generalised forces that rates and wrenches on links (about their centres of mass) need, without those of
  /// accelerated rates. After factor(), and set_velocities() of the same rates.
  void bias(const Eigen::VectorXd& rates, const std::vector<Wrench>& wrenches, Eigen::VectorXd& forces);
  /// Changes the rates by a substep: (M + added) du = step (forces - bias), with the bias at the mean of the rates
  /// before and after, which makes it of second order. After factor(), and set_velocities() of the present rates.
  void push(double step, const std::vector<Wrench>& wrenches, const Eigen::VectorXd& forces);
  /// Moves the joints by the rates.
  void move(double step);
  double kinetic_energy() const;

  /// The link of kFree that carries a link; -1: the world carries it.
  int free_root(int link) const { return links_[index(link)].free_root; }
  /// Of a link, at the present place. After set_velocities().
  TreeMomentum momentum(int link) const;
  /// Changes the velocities of links of kFree, and with them that of all that they carry as if it were rigid, until
  /// these sums are their momenta. The rates keep their values.
  void set_momenta(const std::vector<TreeMomentum>& wanted);

 private:
  struct Placed {
    TreeLink link;
    int first_dof = 0;
    int dof_count = 0;
    int last_dof = -1;
    int free_root = -1;
    Vector3 axis;  // in the parent
  };
  struct Body {
    Matrix3 axes = Matrix3::Identity();
    Quaternion orientation;
    Vector3 centre;  // from the origin
    Vector3 anchor;  // of its joint, likewise
    RigidMotion velocity;
    RigidMotion acceleration;  // the derivative of `velocity` while the rates are constant
    Vector3 force, moment;
    Matrix3 inertia = Matrix3::Zero();  // world axes, about the centre
    // Of the link with all that it carries, about the origin:
    double mass = 0;
    Vector3 first;
    Matrix3 second = Matrix3::Zero();
  };

  static std::size_t index(int number) { return static_cast<std::size_t>(number); }
  const Body& parent_of(const TreeLink& link) const { return link.parent < 0 ? world_ : bodies_[index(link.parent)]; }
  void set_origin(const Vector3& origin);
  void place_joint(int link);
  void set_column(int dof, const RigidMotion& column);
  void accelerate(int link, const Eigen::VectorXd& rates);

  std::vector<Placed> links_;
  std::vector<TreeJointState> joints_;
  std::vector<Body> bodies_;
  Body world_;
  std::vector<RigidMotion> columns_;
  Directions directions_;  // the columns once more
  BranchedMatrix mass_matrix_;
  Eigen::VectorXd rates_, middle_, bias_, change_;
  Vector3 origin_;
};

}  // namespace bubblesim
