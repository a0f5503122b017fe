// SPDX-License-Identifier: BSD-3-Clause
// Forces for sensors: those of contacts and those that joints transmit.
#include <algorithm>

#include "bubblesim/error.hpp"
#include "physics/world/state.hpp"

namespace bubblesim {
namespace {

Touch& touch_of(World::State& state, const Collider* watched, const Collider* other) {
  for (Touch& touch : state.touches) {
    if (touch.watched == watched && touch.other == other) return touch;
  }
  Touch& touch = state.touches.emplace_back();
  touch.watched = watched;
  touch.other = other;
  return touch;
}

void add_point(World::State& state, const FoundPair& pair, const FoundContact& found, bool of_first, double step) {
  Touch& touch = of_first ? touch_of(state, pair.first, pair.second) : touch_of(state, pair.second, pair.first);
  if (touch.step != state.steps) touch.points.clear();
  touch.step = state.steps;
  const double sign = of_first ? 1 : -1;  // the normal points into the first shape
  const Vector3 force = found.force * sign;
  const dContactGeom& geom = found.contact.geom;
  touch.impulse += force * step;
  touch.points.push_back({to_vector(geom.pos), to_vector(geom.normal) * sign, geom.depth, force});
}

/// Wrench of the parent on the child through one of ODE's joints: torque about the child's centre of mass.
Wrench on_child(dJointID joint, const dJointFeedback& feedback, dBodyID child) {
  const dBodyID first = dJointGetBody(joint, 0);
  const dBodyID second = dJointGetBody(joint, 1);
  // A joint with one body reports its force first, whichever place the body has.
  if (first == child || second == nullptr || first == nullptr) return {to_vector(feedback.f1), to_vector(feedback.t1)};
  return {to_vector(feedback.f2), to_vector(feedback.t2)};
}

/// The axes of a force-torque sensor's readings, at the start of the substep.
Quaternion axes_of(ForceTorqueDescription::Frame frame, const WrenchAccumulator& meter, const Quaternion& sensor) {
  switch (frame) {
    case ForceTorqueDescription::Frame::kChild:
      return meter.child.orientation;
    case ForceTorqueDescription::Frame::kParent:
      return meter.parent;
    case ForceTorqueDescription::Frame::kSensor:
      break;
  }
  return sensor;
}

void gather_wrench(const World::State& state, const PlacedJoint& placed, double step) {
  WrenchAccumulator& meter = *placed.meter;
  dBodyID child = state.link(placed.child).body.get();
  Wrench total;  // of the parent on the child, about the child's centre of mass
  for (const JointReport& report : meter.reports) {
    const Wrench wrench = on_child(report.joint, report.feedback, child);
    total.force += wrench.force;
    total.torque += wrench.torque;
  }
  const auto torque_about = [&](const Vector3& point) -> Vector3 {
    return total.torque + (meter.child_centre - point).cross(total.force);
  };
  // The child exerts the opposite wrench on the parent.
  meter.sum.force -= total.force * step;
  meter.sum.torque -= torque_about((meter.child * placed.in_child).position) * step;
  for (WrenchSignal& signal : meter.signals) {
    const Pose sensor = meter.child * signal.in_child;
    const double sign = signal.description.of_child ? -1 : 1;
    const Quaternion axes = axes_of(signal.description.frame, meter, sensor.orientation);
    signal.force.add(axes.conjugate() * (total.force * sign), step);
    signal.torque.add(axes.conjugate() * (torque_about(sensor.position) * sign), step);
  }
}

void clear_meter(WrenchAccumulator& meter) {
  meter.sum = {};
  for (WrenchSignal& signal : meter.signals) {
    signal.force.clear();
    signal.torque.clear();
  }
}

void aim_meter(const World::State& state, const PlacedJoint& placed) {
  WrenchAccumulator& meter = *placed.meter;
  // ODE leaves the feedback of a motor unchanged while it has no force.
  for (JointReport& report : meter.reports) report.feedback = {};
  const Link& child = state.link(placed.child);
  meter.child = link_pose(child);
  meter.child_centre = to_vector(dBodyGetPosition(child.body.get()));
  if (placed.parent != kNoObject) meter.parent = link_pose(state.link(placed.parent)).orientation;
}

}  // namespace

std::unique_ptr<WrenchAccumulator> make_meter(dBodyID parent, dBodyID child) {
  auto meter = std::make_unique<WrenchAccumulator>();
  for (int i = 0; i < dBodyGetNumJoints(child); ++i) {
    dJointID joint = dBodyGetJoint(child, i);
    const dBodyID first = dJointGetBody(joint, 0);
    const dBodyID second = dJointGetBody(joint, 1);
    if ((first == child ? second : first) != parent) continue;
    JointReport& report = meter->reports.emplace_back();
    report.joint = joint;
    dJointSetFeedback(joint, &report.feedback);
  }
  return meter;
}

void aim_meters(World::State& state) {
  for (PlacedModel* model : state.moving) {
    for (auto& [index, meter] : model->motion_meters) meter.begin();
    for (const PlacedJoint& placed : model->joints) {
      if (placed.meter != nullptr) aim_meter(state, placed);
    }
  }
}

void forget_touches(World::State& state) { state.touches.clear(); }

void forget_forces(World::State& state) {
  forget_touches(state);
  state.steps = 0;
  for (PlacedModel* model : state.moving) {
    for (auto& [index, meter] : model->motion_meters) meter.clear();
    for (const PlacedJoint& placed : model->joints) {
      if (placed.meter != nullptr) clear_meter(*placed.meter);
      for (const auto& meter : placed.motor_meters) {
        if (meter != nullptr) meter->clear();
      }
    }
  }
}

void gather_forces(World::State& state, double step) {
  ++state.steps;
  for (const FoundPair& pair : state.found.pairs) {
    if (!pair.first->watched && !pair.second->watched) continue;
    for (std::size_t i = pair.begin; i < pair.begin + static_cast<std::size_t>(pair.count); ++i) {
      if (pair.first->watched) add_point(state, pair, state.found.points[i], true, step);
      if (pair.second->watched) add_point(state, pair, state.found.points[i], false, step);
    }
  }
  for (PlacedModel* model : state.moving) {
    for (auto& [index, meter] : model->motion_meters) meter.end(step, state.gravity);
    for (const PlacedJoint& placed : model->joints) {
      if (placed.meter != nullptr) gather_wrench(state, placed, step);
      for (std::size_t axis = 0; axis < placed.motor_meters.size(); ++axis) {
        if (placed.joint->is_driven(static_cast<int>(axis))) placed.motor_meters[axis]->gather(step);
      }
    }
  }
}

std::vector<Contact> World::contacts(ObjectId link) const {
  if (state_->tree().at(link).kind != ObjectKind::kLink)
    throw WrongObject(state_->shown(link) + " is a " + std::string(kind_name(state_->tree().at(link).kind)) +
                      ", not a link");
  std::vector<Contact> contacts;
  for (const Touch& touch : state_->touches) {
    if (touch.watched->link->object != link) continue;
    contacts.push_back({touch.watched->name, touch.other->link->object, touch.other->name,
                        touch.impulse / state_->last_duration, touch.points});
  }
  return contacts;
}

std::vector<TouchPoint> World::contact_points() const {
  std::vector<TouchPoint> points;
  for (const RememberedPoint& point : state_->memory.points) points.push_back({point.position, point.normal});
  return points;
}

Wrench World::joint_wrench(ObjectId joint) const {
  const Object& object = state_->tree().at(joint);
  const PlacedJoint* placed =
      object.kind == ObjectKind::kJoint ? &state_->model_of(joint).joints[object.index] : nullptr;
  if (placed != nullptr && placed->joint == nullptr) return {};  // of a static model
  if (placed == nullptr || placed->meter == nullptr) {
    throw WrongObject(state_->shown(joint) + " is not a moving joint with a force-torque sensor");
  }
  if (state_->last_duration == 0) return {};
  return {placed->meter->sum.force / state_->last_duration, placed->meter->sum.torque / state_->last_duration};
}

Wrench World::sensor_wrench(ObjectId sensor) const {
  const Object& object = state_->tree().at(sensor);
  const PlacedModel& model = state_->model_of(sensor);
  for (const PlacedJoint& placed : model.joints) {
    if (placed.object != object.parent || placed.meter == nullptr) continue;
    for (const WrenchSignal& signal : placed.meter->signals) {
      if (signal.sensor == object.index) return {signal.force.value(), signal.torque.value()};
    }
  }
  return {};  // of a static model
}

Inertial World::sensor_motion(ObjectId sensor) const {
  const auto& meters = state_->model_of(sensor).motion_meters;
  const auto found = meters.find(state_->tree().at(sensor).index);
  if (found != meters.end() && found->second.has_value()) {
    return {found->second.angular_velocity(), found->second.specific_force()};
  }
  const Quaternion axes = pose(sensor).orientation;
  return {axes.conjugate() * velocity(sensor).angular, axes.conjugate() * -state_->gravity};
}

}  // namespace bubblesim
