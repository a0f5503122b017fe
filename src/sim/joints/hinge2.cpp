// SPDX-License-Identifier: BSD-3-Clause
// revolute2: a steered wheel in one joint. The first axis is fixed in the parent, the second in the child.
#include "kinds.hpp"

namespace bubblesim {
namespace {

class Hinge2 final : public Joint {
 public:
  Hinge2(dWorldID world, const JointDescription& description, const Pose& pose, JointBodies bodies)
      : Joint(description.axes), joint_(dJointCreateHinge2(world, nullptr)) {
    // Hinge2 needs two bodies and wants the one that holds the first axis first: the parent. It counts the turn of the
    // first body relative to the second; about the negative axes, that is the child's about the positive ones.
    dJointAttach(joint_.get(), bodies.parent, bodies.child);
    dJointSetHinge2Anchor(joint_.get(), pose.Pos().X(), pose.Pos().Y(), pose.Pos().Z());
    const Vector3 steering = -pose.Rot().RotateVector(description.axes[0].direction);
    const Vector3 rolling = -pose.Rot().RotateVector(description.axes[1].direction);
    const dVector3 axis1 = {steering.X(), steering.Y(), steering.Z()};
    const dVector3 axis2 = {rolling.X(), rolling.Y(), rolling.Z()};
    dJointSetHinge2Axes(joint_.get(), axis1, axis2);
    steering_motor_ = separate_turning_motor(world, description.axes[0], steering, bodies.parent, bodies.child);
    apply_axes();
  }

  double position(int axis) const override {
    return axis == 0 ? dJointGetHinge2Angle1(joint_.get())
                     : -dJointGetHinge2Angle2(joint_.get());  // against its own rate
  }
  double velocity(int axis) const override {
    return axis == 0 ? dJointGetHinge2Angle1Rate(joint_.get()) : dJointGetHinge2Angle2Rate(joint_.get());
  }

 private:
  void set_stop(int axis, int parameter, double value) override {
    dJointSetHinge2Param(joint_.get(), axis * dParamGroup + parameter, value);
  }
  void set_motor(int axis, int parameter, double value) override {
    if (axis == 0 && steering_motor_ != nullptr) {
      dJointSetAMotorParam(steering_motor_.get(), parameter, value);
    } else {
      dJointSetHinge2Param(joint_.get(), axis * dParamGroup + parameter, value);
    }
  }

  ode::JointHandle joint_;
  ode::JointHandle steering_motor_;  // null when the joint drives itself
};

}  // namespace

std::unique_ptr<Joint> make_hinge2(dWorldID world, const JointDescription& description, const Pose& pose,
                                   JointBodies bodies) {
  return std::make_unique<Hinge2>(world, description, pose, bodies);
}

}  // namespace bubblesim
