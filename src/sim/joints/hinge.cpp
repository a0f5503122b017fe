// SPDX-License-Identifier: BSD-3-Clause
// revolute and continuous: the child turns about one axis.
#include <cmath>

#include "kinds.hpp"

namespace bubblesim {
namespace {

class Hinge final : public Joint {
 public:
  Hinge(dWorldID world, const JointDescription& description, const Pose& pose, JointBodies bodies)
      : Joint(description.axes), joint_(dJointCreateHinge(world, nullptr)) {
    // Child first: ODE counts the angle of the first body relative to the second.
    dJointAttach(joint_.get(), bodies.child, bodies.parent);
    const Vector3 axis = pose.Rot().RotateVector(description.axes[0].direction);
    dJointSetHingeAnchor(joint_.get(), pose.Pos().X(), pose.Pos().Y(), pose.Pos().Z());
    dJointSetHingeAxis(joint_.get(), axis.X(), axis.Y(), axis.Z());
    motor_ = separate_turning_motor(world, description.axes[0], axis, bodies.child, bodies.parent);
    const double lower = description.axes[0].lower;
    const double upper = description.axes[0].upper;
    counts_turns_ =
        (std::isfinite(lower) && std::abs(lower) > M_PI) || (std::isfinite(upper) && std::abs(upper) > M_PI);
    apply_axes();
  }

  /// From -pi to pi, unless there are limits beyond: then whole turns count.
  double position(int) const override {
    const double angle = dJointGetHingeAngle(joint_.get());
    return counts_turns_ ? angle + 2 * M_PI * std::round((followed_ - angle) / (2 * M_PI)) : angle;
  }
  double velocity(int) const override { return dJointGetHingeAngleRate(joint_.get()); }

 private:
  void set_stop(int, int parameter, double value) override { dJointSetHingeParam(joint_.get(), parameter, value); }
  void set_motor(int, int parameter, double value) override {
    motor_ != nullptr ? dJointSetAMotorParam(motor_.get(), parameter, value)
                      : dJointSetHingeParam(joint_.get(), parameter, value);
  }

  void follow() override {
    if (!counts_turns_) return;
    followed_ = position(0);
    // ODE knows angles from -pi to pi only and compares them with the stops: move those into the turn that we are in.
    const double turns = followed_ - dJointGetHingeAngle(joint_.get());
    if (std::isfinite(axis(0).lower)) set_stop(0, dParamLoStop, axis(0).lower - turns);
    if (std::isfinite(axis(0).upper)) set_stop(0, dParamHiStop, axis(0).upper - turns);
  }

  ode::JointHandle joint_;
  ode::JointHandle motor_;  // null when the hinge drives itself
  bool counts_turns_ = false;
  double followed_ = 0;  // rad, position at the last substep
};

}  // namespace

std::unique_ptr<Joint> make_hinge(dWorldID world, const JointDescription& description, const Pose& pose,
                                  JointBodies bodies) {
  return std::make_unique<Hinge>(world, description, pose, bodies);
}

}  // namespace bubblesim
