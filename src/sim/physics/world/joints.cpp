// SPDX-License-Identifier: BSD-3-Clause
// Joints: their positions, and commands for their motors.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "bubblesim/error.hpp"
#include "bubblesim/world_joints.hpp"
#include "physics/world/state.hpp"
#include "scene/describe.hpp"
#include "scene/joint_kind.hpp"
#include "validation/limits.hpp"

namespace bubblesim {
namespace {

constexpr double kMaxTarget = 1e6;  // rad, m, rad/s or m/s

const PlacedJoint& placed_joint(const WorldState& state, ObjectId id) {
  const Object& object = state.tree().at(id);
  if (object.kind != ObjectKind::kJoint) {
    throw WrongObject(state.shown(id) + " is a " + std::string(kind_name(object.kind)) + ", not a joint");
  }
  return state.model_of(id).joints[object.index];
}

constexpr double kMaxGain = 1000;  // of motors

/// A joint and one of its axes. The second axis of a joint is a separate object.
struct JointAxis {
  Joint& joint;
  int index;
};

JointAxis joint_axis(const WorldState& state, ObjectId id, int axis) {
  const PlacedJoint& placed = placed_joint(state, id);
  if (placed.object != id) axis = 1;
  if (placed.joint == nullptr) throw WrongObject(state.shown(id) + " belongs to a static model: it does not move");
  if (axis < 0 || axis >= placed.joint->axis_count()) {
    throw WrongObject(state.shown(id) + " has " + std::to_string(placed.joint->axis_count()) +
                      " axes: there is no axis with index " + std::to_string(axis));
  }
  return {*placed.joint, axis};
}

void check_target(const WorldState& state, ObjectId id, const char* what, double value) {
  if (within(value, kMaxTarget)) return;
  throw InvalidInput(state.shown(id) + ": the " + what + " " + text(value) +
                     " is not usable: it must be finite and at most 1e6");
}

/// The links that are connected to a joint's child by other joints, and the child itself.
std::vector<ObjectId> hanging_on(const PlacedModel& model, const PlacedJoint& joint) {
  std::vector<ObjectId> found{joint.child};
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (const PlacedJoint& other : model.joints) {
      if (&other == &joint) continue;
      for (const auto& [here, there] : {std::pair(other.parent, other.child), std::pair(other.child, other.parent)}) {
        if (here != found[i] || there == kNoObject) continue;
        if (std::find(found.begin(), found.end(), there) == found.end()) found.push_back(there);
      }
    }
  }
  return found;
}

}  // namespace

Pose WorldJoints::child_pose(ObjectId joint) const {
  const PlacedJoint& placed = placed_joint(state(), joint);
  return link_pose(state().link(placed.child)) * placed.in_child;
}

double WorldJoints::position(ObjectId joint, int axis) const {
  const JointAxis found = joint_axis(state(), joint, axis);
  return found.joint.position(found.index);
}

double WorldJoints::velocity(ObjectId joint, int axis) const {
  const JointAxis found = joint_axis(state(), joint, axis);
  return found.joint.velocity(found.index);
}

double WorldJoints::motor_effort(ObjectId joint, int axis) const {
  const int index = joint_axis(state(), joint, axis).index;
  const auto& meter = placed_joint(state(), joint).motor_meters[static_cast<std::size_t>(index)];
  return meter == nullptr || state().last_duration == 0 ? 0 : meter->impulse() / state().last_duration;
}

std::pair<ObjectId, ObjectId> WorldJoints::links(ObjectId joint) const {
  const PlacedJoint& placed = placed_joint(state(), joint);
  return {placed.parent, placed.child};
}

int WorldJoints::axes(ObjectId joint) const {
  const PlacedJoint& placed = placed_joint(state(), joint);
  return placed.joint == nullptr ? 0 : placed.joint->axis_count();
}

double WorldJoints::target_position(ObjectId joint, int axis) const {
  const JointAxis found = joint_axis(state(), joint, axis);
  return found.joint.target_position(found.index);
}

double WorldJoints::target_velocity(ObjectId joint, int axis) const {
  const JointAxis found = joint_axis(state(), joint, axis);
  return found.joint.target_velocity(found.index);
}

double WorldJoints::target_effort(ObjectId joint, int axis) const {
  const JointAxis found = joint_axis(state(), joint, axis);
  return found.joint.target_effort(found.index);
}

double WorldJoints::max_force(ObjectId joint, int axis) const {
  const JointAxis found = joint_axis(state(), joint, axis);
  return found.joint.axis(found.index).max_force;
}

MotorMode WorldJoints::motor_mode(ObjectId joint, int axis) const {
  const JointAxis found = joint_axis(state(), joint, axis);
  return found.joint.axis(found.index).motor;
}

void WorldJoints::set_motor_mode(ObjectId joint, MotorMode mode, int axis) {
  const JointAxis found = joint_axis(state(), joint, axis);
  if (mode != MotorMode::kNone && found.joint.motor_joint(found.index) == nullptr) {
    throw WrongObject(state().shown(joint) + " is a gearbox, which has no motor: drive one of the hinges of its links");
  }
  found.joint.set_motor_mode(found.index, mode);
}

void WorldJoints::set_target_position(ObjectId joint, double position, int axis) {
  const JointAxis found = joint_axis(state(), joint, axis);
  check_target(state(), joint, "target position", position);
  found.joint.set_target_position(found.index, position);
}

void WorldJoints::set_target_velocity(ObjectId joint, double velocity, int axis) {
  const JointAxis found = joint_axis(state(), joint, axis);
  check_target(state(), joint, "target velocity", velocity);
  found.joint.set_target_velocity(found.index, velocity);
}

void WorldJoints::set_target_effort(ObjectId joint, double effort, int axis) {
  const JointAxis found = joint_axis(state(), joint, axis);
  if (!within(effort, kMaxEffort)) {
    throw InvalidInput(state().shown(joint) + ": the target effort " + text(effort) +
                       " is not usable: it must be finite and at most 1e9");
  }
  found.joint.set_target_effort(found.index, effort);
}

const JointDescription& WorldJoints::description(ObjectId joint) const {
  placed_joint(state(), joint);
  return state().model_of(joint).description.joints[state().tree().at(joint).index];
}

void WorldJoints::set_position(ObjectId joint, double position) {
  const PlacedJoint& placed = placed_joint(state(), joint);
  const JointDescription& description = this->description(joint);
  const JointKind& kind = *find_joint_kind(description.type);
  if (!kind.slides && !kind.is_hinge) {
    throw WrongObject(state().shown(joint) + " is a " + description.type +
                      " joint: the position can be set only for revolute, continuous and prismatic joints");
  }
  check_target(state(), joint, "position", position);
  const double way = position - this->position(joint);
  const Pose frame = pose_of(state(), joint);
  const Vector3 axis = frame.orientation * description.axes.front().direction;
  Pose motion;
  if (kind.slides) {
    motion.position = way * axis;
  } else {
    motion.orientation = Quaternion(Eigen::AngleAxisd(way, axis.normalized()));
    motion.position = frame.position - motion.orientation * frame.position;
  }
  const std::vector<ObjectId> moved = hanging_on(state().model_of(joint), placed);
  if (std::find(moved.begin(), moved.end(), placed.parent) != moved.end()) {
    throw WrongObject(state().shown(joint) + " belongs to a closed chain of links: its position cannot be set");
  }
  move_links(state(), {moved.begin(), moved.end()}, motion);
}

void WorldJoints::set_max_force(ObjectId joint, double force, int axis) {
  const JointAxis found = joint_axis(state(), joint, axis);
  if (!(force >= 0)) {
    throw InvalidInput(state().shown(joint) + ": the force limit " + text(force) +
                       " is not usable: it must be zero or more");
  }
  found.joint.set_max_force(found.index, force);
}

double WorldJoints::motor_gain(ObjectId joint, int axis) const {
  const JointAxis found = joint_axis(state(), joint, axis);
  return found.joint.motor_gain(found.index);
}

void WorldJoints::set_motor_gain(ObjectId joint, double gain, int axis) {
  const JointAxis found = joint_axis(state(), joint, axis);
  if (!(gain >= 0 && gain <= kMaxGain)) {
    throw InvalidInput(state().shown(joint) + ": the motor gain " + text(gain) +
                       " is not usable: it must be from 0 to 1000");
  }
  found.joint.set_motor_gain(found.index, gain);
}

}  // namespace bubblesim
