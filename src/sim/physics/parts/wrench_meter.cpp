// SPDX-License-Identifier: BSD-3-Clause
#include "physics/parts/wrench_meter.hpp"

#include "physics/ode/ode_math.hpp"

namespace bubblesim {
namespace {

/// Wrench of the parent on the child through one of ODE's joints: torque about the child's centre of mass.
Wrench on_child(dJointID joint, const dJointFeedback& feedback, dBodyID child) {
  const dBodyID first = dJointGetBody(joint, 0);
  const dBodyID second = dJointGetBody(joint, 1);
  // A joint with one body reports its force first, whichever place the body has.
  if (first == child || second == nullptr || first == nullptr) return {to_vector(feedback.f1), to_vector(feedback.t1)};
  return {to_vector(feedback.f2), to_vector(feedback.t2)};
}

}  // namespace

WrenchMeter::WrenchMeter(const Link* parent, const Link& child, const Pose& joint_in_child)
    : parent_(parent), child_(child), joint_in_child_(joint_in_child) {
  dBodyID body = child.body.get();
  const dBodyID other = parent == nullptr ? nullptr : parent->body.get();
  for (int i = 0; i < dBodyGetNumJoints(body); ++i) {
    dJointID joint = dBodyGetJoint(body, i);
    const dBodyID first = dJointGetBody(joint, 0);
    const dBodyID second = dJointGetBody(joint, 1);
    if ((first == body ? second : first) != other) continue;
    Report& report = reports_.emplace_back();
    report.joint = joint;
    dJointSetFeedback(joint, &report.feedback);
  }
}

void WrenchMeter::add_sensor(const ForceTorqueDescription& description, std::size_t sensor, const Pose& in_joint) {
  Signal& signal = signals_.emplace_back(description);
  signal.sensor = sensor;
  signal.in_joint = in_joint;
}

void WrenchMeter::clear() {
  impulse_ = {};
  for (Signal& signal : signals_) {
    signal.force.clear();
    signal.torque.clear();
  }
}

void WrenchMeter::begin() {
  // ODE leaves the feedback of a motor unchanged while it has no force.
  for (Report& report : reports_) report.feedback = {};
  reported_.reset();
  child_pose_ = link_pose(child_);
  child_centre_ = to_vector(dBodyGetPosition(child_.body.get()));
  if (parent_ != nullptr) parent_axes_ = link_pose(*parent_).orientation;
}

void WrenchMeter::report(const Wrench& impulse, const Vector3& point) {
  reported_ = impulse;
  reported_about_ = point;
}

Wrench WrenchMeter::from_feedback() const {
  Wrench total;
  for (const Report& report : reports_) {
    const Wrench wrench = on_child(report.joint, report.feedback, child_.body.get());
    total.force += wrench.force;
    total.torque += wrench.torque;
  }
  return total;
}

Wrench WrenchMeter::from_solver(double step) {
  const Pose now = link_pose(child_);
  child_pose_ = {(child_pose_.position + now.position) / 2, child_pose_.orientation.slerp(0.5, now.orientation)};
  child_centre_ = (child_centre_ + to_vector(dBodyGetPosition(child_.body.get()))) / 2;
  if (parent_ != nullptr) parent_axes_ = parent_axes_.slerp(0.5, link_pose(*parent_).orientation);
  const Vector3 force = reported_->force / step;
  return {force, reported_->torque / step + (reported_about_ - child_centre_).cross(force)};
}

void WrenchMeter::end(double step) {
  const Wrench total = reported_ ? from_solver(step) : from_feedback();  // on the child, about its centre of mass
  const auto torque_about = [&](const Vector3& point) -> Vector3 {
    return total.torque + (child_centre_ - point).cross(total.force);
  };
  // The child exerts the opposite wrench on the parent.
  impulse_.force -= total.force * step;
  impulse_.torque -= torque_about((child_pose_ * joint_in_child_).position) * step;
  for (Signal& signal : signals_) {
    const Pose sensor = child_pose_ * joint_in_child_ * signal.in_joint;
    const double sign = signal.description.of_child ? -1 : 1;
    const Quaternion axes = axes_of(signal.description.frame, sensor.orientation);
    signal.force.add(axes.conjugate() * (total.force * sign), step);
    signal.torque.add(axes.conjugate() * (torque_about(sensor.position) * sign), step);
  }
}

/// The axes of a sensor's readings, at the start of the substep.
Quaternion WrenchMeter::axes_of(ForceTorqueDescription::Frame frame, const Quaternion& sensor) const {
  switch (frame) {
    case ForceTorqueDescription::Frame::kChild:
      return child_pose_.orientation;
    case ForceTorqueDescription::Frame::kParent:
      return parent_axes_;
    case ForceTorqueDescription::Frame::kSensor:
      break;
  }
  return sensor;
}

std::optional<Wrench> WrenchMeter::of_sensor(std::size_t sensor) const {
  for (const Signal& signal : signals_) {
    if (signal.sensor == sensor) return Wrench{signal.force.value(), signal.torque.value()};
  }
  return {};
}

void WrenchMeter::transfer(StateArchive& archive) {
  archive(impulse_);
  for (Signal& signal : signals_) archive(signal.force, signal.torque);
}

}  // namespace bubblesim
