// SPDX-License-Identifier: BSD-3-Clause
// screw: the child rotates about an axis and slides along it by its lead per turn.
#include <cmath>

#include "physics/joints/kinds.hpp"
#include "physics/joints/point_velocity_constraint.hpp"
#include "physics/ode/constraint_defaults.hpp"

namespace bubblesim {
namespace {

class Screw final : public Joint {
 public:
  Screw(dWorldID world, const JointDescription& description, const JointSite& site)
      : Joint(description.axes),
        joint_(dJointCreatePiston(world, nullptr)),
        thread_(world),
        child_(site.child),
        parent_(site.parent),
        slope_(description.screw_lead / (2 * M_PI)) {
    dJointAttach(joint_.get(), site.child, site.parent);
    const Vector3 direction = axis_direction(description, 0, site);
    dJointSetPistonAnchor(joint_.get(), site.pose.position.x(), site.pose.position.y(), site.pose.position.z());
    dJointSetPistonAxis(joint_.get(), direction.x(), direction.y(), direction.z());
    add_rows(world, Motor(joint_.get(), dJointSetPistonParam, 1), Motion::kTurns, {direction, site.child, site.parent});
  }

  /// Radians, counting full turns.
  double position(int) const override { return dJointGetPistonPosition(joint_.get()) / slope_; }
  double velocity(int) const override { return dJointGetPistonPositionRate(joint_.get()) / slope_; }

 private:
  void follow(double step) override {
    const double angle = dJointGetPistonAngle(joint_.get());  // from -pi to pi
    const double turns = 2 * M_PI * std::round((position(0) - angle) / (2 * M_PI));
    shift_limits(0, position(0) - angle);
    mesh(dJointGetPistonPosition(joint_.get()) - slope_ * (angle + turns), step);
  }

  /// `error`: distance in m by which the slide is ahead of the rotation.
  void mesh(double error, double step) {
    dVector3 axis;
    dVector3 out;
    dVector3 round;
    dVector3 anchor;
    dJointGetPistonAxis(joint_.get(), axis);
    dPlaneSpace(axis, out, round);  // round = axis x out
    dJointGetPistonAnchor2(joint_.get(), anchor);
    const double radius = std::abs(slope_);
    // Perpendicular to the thread, which climbs `slope` per radian at this radius.
    const Vector3 along = Vector3(axis[0], axis[1], axis[2]) * radius - Vector3(round[0], round[1], round[2]) * slope_;
    const Vector3 point = Vector3(anchor[0], anchor[1], anchor[2]) + Vector3(out[0], out[1], out[2]) * radius;
    thread_.hold(child_, parent_, point, along.normalized(), -kErrorReduction * error / step * radius / along.norm());
  }

  ode::JointHandle joint_;
  PointVelocityConstraint thread_;
  dBodyID child_;
  dBodyID parent_;
  double slope_;  // m/rad, along the axis
};

}  // namespace

std::unique_ptr<Joint> make_screw(dWorldID world, const JointDescription& description, const JointSite& site) {
  return std::make_unique<Screw>(world, description, site);
}

}  // namespace bubblesim
