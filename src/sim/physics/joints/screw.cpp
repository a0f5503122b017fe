// SPDX-License-Identifier: BSD-3-Clause
// screw: the child rotates about an axis and slides along it by its lead per turn.
#include <cmath>

#include "load/load_context.hpp"
#include "load/sdf/elements/sdf_element.hpp"
#include "physics/joints/define.hpp"
#include "physics/joints/point_velocity_constraint.hpp"
#include "physics/ode/constraint_defaults.hpp"
#include "scene/describe.hpp"
#include "validation/checker.hpp"
#include "validation/limits.hpp"

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

class ScrewKind final : public JointKind {
 public:
  ScrewKind() : JointKind("screw", 1) {}

  /// Metres per turn, from an element in one of two conventions.
  void read(const SdfElement& joint, const std::string& path, LoadContext& context,
            JointDescription& description) const override {
    // SDFormat 1.10: metres per turn, right-handed.
    if (joint.has("screw_thread_pitch")) {
      description.screw_lead = joint.number("screw_thread_pitch");
      return;
    }
    // Before: radians per metre, left-handed.
    const double pitch = joint.number("thread_pitch");
    if (pitch == 0) context.report(joint.source("thread_pitch"), path, "<thread_pitch> is 0, it must not be 0");
    description.screw_lead = pitch == 0 ? 1 : -2 * M_PI / pitch;
  }

  void check(Checker& checker, const ModelDescription&, const JointDescription& joint) const override {
    checker.require(std::abs(joint.screw_lead) >= 1e-6 && within(joint.screw_lead, 1e3), "the screw's lead",
                    text(joint.screw_lead) + " m", "1e-6 to 1e3 m per turn in absolute value");
  }

  std::unique_ptr<Joint> make(dxWorld* world, const JointDescription& description,
                              const JointSite& site) const override {
    return std::make_unique<Screw>(world, description, site);
  }
};

template const JointKind& joint_kind<ScrewKind>();

}  // namespace bubblesim
