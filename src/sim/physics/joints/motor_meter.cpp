// SPDX-License-Identifier: BSD-3-Clause
#include "physics/joints/motor_meter.hpp"

#include "physics/ode/ode_math.hpp"

namespace bubblesim {
namespace {

Vector3 in_body(dBodyID body, const Vector3& v) {
  if (body == nullptr) return v;
  dVector3 result;
  dBodyVectorFromWorld(body, v.x(), v.y(), v.z(), result);
  return to_vector(result);
}

Vector3 in_world(dBodyID body, const Vector3& v) {
  if (body == nullptr) return v;
  dVector3 result;
  dBodyVectorToWorld(body, v.x(), v.y(), v.z(), result);
  return to_vector(result);
}

}  // namespace

MotorMeter::MotorMeter(const MeteredAxis& axis) : axis_(axis) {
  place(axis.direction, axis.origin);
  // A joint with one body reports its force first, whichever place the body has.
  dBodyID first = dJointGetBody(axis.joint, 0);
  child_first_ = first == axis.child || first == nullptr || dJointGetBody(axis.joint, 1) == nullptr;
  if (dJointGetFeedback(axis.joint) == nullptr) dJointSetFeedback(axis.joint, &feedback_);
}

void MotorMeter::place(const Vector3& direction, const Vector3& origin) {
  direction_in_carrier_ = in_body(axis_.carrier, direction);
  lever_in_child_ = in_body(axis_.child, to_vector(dBodyGetPosition(axis_.child)) - origin);
}

void MotorMeter::aim() {
  direction_ = in_world(axis_.carrier, direction_in_carrier_);
  if (!axis_.slides) lever_ = in_world(axis_.child, lever_in_child_);
  *dJointGetFeedback(axis_.joint) = {};  // ODE leaves it unchanged while the motor has no force
}

void MotorMeter::gather(double step) {
  const dJointFeedback& feedback = *dJointGetFeedback(axis_.joint);
  const Vector3 force = to_vector(child_first_ ? feedback.f1 : feedback.f2);
  if (axis_.slides) {
    impulse_ += force.dot(direction_) * step;
  } else {
    const Vector3 torque = to_vector(child_first_ ? feedback.t1 : feedback.t2);
    impulse_ += (torque + lever_.cross(force)).dot(direction_) * step;
  }
}

}  // namespace bubblesim
