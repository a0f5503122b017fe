// SPDX-License-Identifier: BSD-3-Clause
// prismatic: the child slides along one axis.
#include "kinds.hpp"

namespace bubblesim {
namespace {

class Slider final : public Joint {
 public:
  Slider(dWorldID world, const JointDescription& description, const Pose& pose, JointBodies bodies)
      : Joint(description.axes), joint_(dJointCreateSlider(world, nullptr)) {
    dJointAttach(joint_.get(), bodies.child, bodies.parent);
    const Vector3 axis = pose.Rot().RotateVector(description.axes[0].direction);
    dJointSetSliderAxis(joint_.get(), axis.X(), axis.Y(), axis.Z());
    motor_ = separate_sliding_motor(world, description.axes[0], axis, bodies.child, bodies.parent);
    apply_axes();
  }

  double position(int) const override { return dJointGetSliderPosition(joint_.get()); }
  double velocity(int) const override { return dJointGetSliderPositionRate(joint_.get()); }

 private:
  void set_stop(int, int parameter, double value) override { dJointSetSliderParam(joint_.get(), parameter, value); }
  void set_motor(int, int parameter, double value) override {
    motor_ != nullptr ? dJointSetLMotorParam(motor_.get(), parameter, value)
                      : dJointSetSliderParam(joint_.get(), parameter, value);
  }

  ode::JointHandle joint_;
  ode::JointHandle motor_;  // null when the slider drives itself
};

}  // namespace

std::unique_ptr<Joint> make_slider(dWorldID world, const JointDescription& description, const Pose& pose,
                                   JointBodies bodies) {
  return std::make_unique<Slider>(world, description, pose, bodies);
}

}  // namespace bubblesim
