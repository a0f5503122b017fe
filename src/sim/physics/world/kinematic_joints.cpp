// SPDX-License-Identifier: BSD-3-Clause
// Joints without physics: what is below them in the tree moves when their position is set.
#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "physics/world/state.hpp"

namespace bubblesim {
namespace {

/// The joint with a name, with physics or without; kNoObject if there is none.
ObjectId joint_named(const WorldState& state, const std::string& name) {
  for (const auto& [id, frame] : state.frames) {
    if (frame.joint != nullptr && frame.joint->name == name) return id;
  }
  for (const auto& model : state.models) {
    for (std::size_t i = 0; i < model->joints.size(); ++i) {
      if (model->description.joints[i].name == name) return model->joints[i].object;
    }
  }
  return kNoObject;
}

const MimicDescription* mimic_of(const PlacedFrame& frame) {
  if (frame.joint == nullptr || frame.joint->joint->axes.empty()) return nullptr;
  const auto& mimic = frame.joint->joint->axes.front().mimic;
  return mimic ? &*mimic : nullptr;
}

double within_limits(const PlacedFrame& placed, double position) {
  const std::vector<AxisDescription>& axes = placed.joint->joint->axes;
  if (axes.empty() || axes.front().lower > axes.front().upper) return position;
  return std::clamp(position, axes.front().lower, axes.front().upper);
}

void set_one(WorldState& state, ObjectId joint, double position) {
  PlacedFrame& placed = *kinematic_joint(state, joint);
  const Pose frame = frame_pose(state, placed);
  const Pose before = frame * motion_of(placed);
  placed.position = within_limits(placed, position);
  move_children(state, joint, before, frame * motion_of(placed));
}

}  // namespace

const PlacedFrame* kinematic_joint(const WorldState& state, ObjectId object) {
  const auto found = state.frames.find(object);
  return found == state.frames.end() || found->second.joint == nullptr ? nullptr : &found->second;
}

PlacedFrame* kinematic_joint(WorldState& state, ObjectId object) {
  const auto found = state.frames.find(object);
  return found == state.frames.end() || found->second.joint == nullptr ? nullptr : &found->second;
}

Pose motion_of(const PlacedFrame& placed) {
  const JointDescription& joint = *placed.joint->joint;
  if (joint.type == "ball") return {};
  if (joint.type == "prismatic") return {Vector3(0, 0, placed.position), Quaternion()};
  const double lead = joint.type == "screw" ? joint.screw_lead / (2 * M_PI) : 0;  // m per rad
  return {Vector3(0, 0, lead * placed.position),
          Quaternion(Eigen::AngleAxisd(placed.position, Eigen::Vector3d::UnitZ()))};
}

void set_kinematic_position(WorldState& state, ObjectId joint, double position) {
  std::vector<std::pair<ObjectId, double>> open{{joint, position}};
  std::set<ObjectId> set;  // joints may follow each other in a circle
  while (!open.empty()) {
    const auto [next, wanted] = open.back();
    open.pop_back();
    if (!set.insert(next).second) continue;
    set_one(state, next, wanted);
    const double reached = kinematic_joint(state, next)->position;
    for (const auto& [id, frame] : state.frames) {
      const MimicDescription* mimic = mimic_of(frame);
      if (mimic != nullptr && frame.leader == next) open.emplace_back(id, mimic->offset + mimic->multiplier * reached);
    }
  }
}

void find_leaders(WorldState& state) {
  for (auto& [id, frame] : state.frames) {
    if (const MimicDescription* mimic = mimic_of(frame)) frame.leader = joint_named(state, mimic->joint);
  }
}

void move_kinematic_joints(WorldState& state, double duration) {
  std::vector<std::pair<ObjectId, double>> wanted;
  for (const auto& [id, frame] : state.frames) {
    if (frame.joint == nullptr) continue;
    if (frame.velocity != 0) wanted.emplace_back(id, frame.position + frame.velocity * duration);
    const MimicDescription* mimic = mimic_of(frame);
    if (mimic == nullptr || frame.leader == kNoObject || !state.tree().contains(frame.leader)) continue;
    const Object& leader = state.tree().at(frame.leader);
    if (leader.kind != ObjectKind::kJoint) continue;
    const std::unique_ptr<Joint>& joint = state.model_of(leader.id).joints[leader.index].joint;
    if (joint == nullptr || joint->axis_count() == 0) continue;
    wanted.emplace_back(id, mimic->offset + mimic->multiplier * joint->position(0));
  }
  for (const auto& [id, position] : wanted) {
    if (kinematic_joint(state, id)->position != position) set_kinematic_position(state, id, position);
  }
}

}  // namespace bubblesim
