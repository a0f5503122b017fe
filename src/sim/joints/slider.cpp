// SPDX-License-Identifier: BSD-3-Clause
// prismatic: the child slides along one axis.
#include "kinds.hpp"

namespace bubblesim {
namespace {

class Slider final : public Joint {
 public:
  Slider(dWorldID world, const JointDescription& description, const Pose& pose, JointBodies bodies)
      : Joint(description.axes), joint_(dJointCreateSlider(world, nullptr)) {
    dJointAttach(joint_, bodies.child, bodies.parent);
    const Vector3 axis = pose.Rot().RotateVector(description.axes[0].direction);
    dJointSetSliderAxis(joint_, axis.X(), axis.Y(), axis.Z());
    motor_ = separate_sliding_motor(world, description.axes[0], axis, bodies.child, bodies.parent);
    apply_axes();
  }

  double position(int) const override { return dJointGetSliderPosition(joint_); }
  double velocity(int) const override { return dJointGetSliderPositionRate(joint_); }

 private:
  void set_stop(int, int parameter, double value) override { dJointSetSliderParam(joint_, parameter, value); }
  void set_motor(int, int parameter, double value) override {
    motor_ != nullptr ? dJointSetLMotorParam(motor_, parameter, value) : dJointSetSliderParam(joint_, parameter, value);
  }

  dJointID joint_;            // owned by the ODE world
  dJointID motor_ = nullptr;  // too; null when the slider drives itself
};

}  // namespace

std::unique_ptr<Joint> make_slider(dWorldID world, const JointDescription& description, const Pose& pose,
                                   JointBodies bodies) {
  return std::make_unique<Slider>(world, description, pose, bodies);
}

}  // namespace bubblesim
