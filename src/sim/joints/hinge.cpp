// SPDX-License-Identifier: BSD-3-Clause
// revolute and continuous: the child turns about one axis.
#include "kinds.hpp"

namespace bubblesim {
namespace {

class Hinge final : public Joint {
 public:
  Hinge(dWorldID world, const JointDescription& description, const Pose& pose, JointBodies bodies)
      : Joint(description.axes), joint_(dJointCreateHinge(world, nullptr)) {
    // Child first: ODE counts the angle of the first body relative to the second.
    dJointAttach(joint_, bodies.child, bodies.parent);
    const Vector3 axis = pose.Rot().RotateVector(description.axes[0].direction);
    dJointSetHingeAnchor(joint_, pose.Pos().X(), pose.Pos().Y(), pose.Pos().Z());
    dJointSetHingeAxis(joint_, axis.X(), axis.Y(), axis.Z());
    apply_axes();
  }

  double position(int) const override { return dJointGetHingeAngle(joint_); }
  double velocity(int) const override { return dJointGetHingeAngleRate(joint_); }

 private:
  void set_parameter(int, int parameter, double value) override { dJointSetHingeParam(joint_, parameter, value); }

  dJointID joint_;  // owned by the ODE world
};

}  // namespace

std::unique_ptr<Joint> make_hinge(dWorldID world, const JointDescription& description, const Pose& pose,
                                  JointBodies bodies) {
  return std::make_unique<Hinge>(world, description, pose, bodies);
}

}  // namespace bubblesim
