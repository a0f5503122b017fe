// SPDX-License-Identifier: BSD-3-Clause
// The tree of a world's objects while it runs, and its frames: objects without physics.
#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bubblesim/error.hpp"
#include "bubblesim/world_frames.hpp"
#include "physics/world/state.hpp"
#include "scene/describe.hpp"
#include "scene/fnv1a.hpp"

namespace bubblesim {
namespace {

/// The link with a name, kNoObject for none.
ObjectId link_of(const PlacedModel& model, const std::string& name) {
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    if (model.description.links[i].name == name) return model.links[i].object;
  }
  return kNoObject;
}

PlacedFrame placed(const FrameDescription& description, ObjectId link) {
  PlacedFrame frame{link, description.pose, description.kind};
  if (description.joint) {
    frame.joint = &description;
    frame.position = description.joint_position;
  }
  return frame;
}

/// The link that a frame below this object moves with.
ObjectId link_that_carries(const WorldState& state, ObjectId parent) {
  if (parent == kNoObject) return kNoObject;
  const Object& object = state.tree().at(parent);
  if (object.kind != ObjectKind::kJoint) return carrier(state, object);
  return state.model_of(parent).joints[object.index].child;  // below a joint is what it moves
}

void carry(WorldState& state, ObjectId frame, ObjectId link) {
  PlacedFrame& placed = state.frames.at(frame);
  if (placed.link == link) return;
  const Pose before = frame_pose(state, placed);
  placed.link = link;
  placed.pose = link == kNoObject ? before : link_pose(state.link(link)).inverse() * before;
}

}  // namespace

Pose frame_pose(const WorldState& state, const PlacedFrame& frame) {
  return frame.link == kNoObject ? frame.pose : link_pose(state.link(frame.link)) * frame.pose;
}

SceneTree& changing_tree(WorldState& state) {
  // The scene and its other simulations keep their tree.
  if (state.own_tree == nullptr || state.own_tree.use_count() > 2) {
    state.own_tree = std::make_shared<SceneTree>(*state.shared_tree);
    state.shared_tree = state.own_tree;
  }
  return *state.own_tree;
}

void place_frames(WorldState& state, const PlacedModel& model) {
  const std::vector<FrameDescription>& described = model.description.frames;
  if (described.empty()) return;
  const std::vector<ObjectId> ids = state.tree().parts(model.object, ObjectKind::kFrame);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    state.frames[ids[i]] = placed(described[i], link_of(model, described[i].link));
  }
}

void place_frames(WorldState& state, const std::vector<FrameDescription>& frames) {
  if (frames.empty()) return;
  for (const ObjectId id : state.tree().objects()) {
    const Object& object = state.tree().at(id);
    const bool is_of_scene = object.kind == ObjectKind::kFrame && object.model == kNoObject;
    if (is_of_scene && object.index < frames.size()) state.frames[id] = placed(frames[object.index], kNoObject);
  }
}

void transfer_frames(StateArchive& archive, WorldState& state) {
  for (auto& [id, frame] : state.frames) {
    if (!frame.is_added) archive(frame.link, frame.pose, frame.position, frame.velocity);
  }
}

void add_frames(Fnv1a& hash, const WorldState& state) {
  for (const auto& [id, frame] : state.frames) {
    if (frame.is_added) continue;
    const Pose pose = frame_pose(state, frame);
    const double numbers[] = {pose.position.x(),    pose.position.y(),    pose.position.z(),   pose.orientation.x(),
                              pose.orientation.y(), pose.orientation.z(), pose.orientation.w()};
    hash.add(numbers, 7);
    if (frame.joint != nullptr) hash.add(&frame.position, 1);
  }
}

ObjectId WorldFrames::add_dummy(std::string name) {
  const ObjectId id = changing_tree(state()).add(ObjectKind::kFrame, std::move(name), kNoObject, kAddedFrame);
  state().frames[id] = {kNoObject, Pose(), FrameKind::kDummy, true};
  return id;
}

ObjectId WorldFrames::add_joint(std::string name, const std::string& type) {
  const std::array<const char*, 4> types{"revolute", "continuous", "prismatic", "ball"};
  if (std::find(types.begin(), types.end(), type) == types.end()) {
    throw InvalidInput("a joint of the type '" + type + "' cannot be added: revolute, continuous, prismatic or ball");
  }
  const ObjectId id = add_dummy(std::move(name));
  PlacedFrame& frame = state().frames.at(id);
  frame.kind = FrameKind::kJoint;
  frame.own = std::make_shared<FrameDescription>();
  frame.own->joint.emplace().type = type;
  if (type != "ball") frame.own->joint->axes.emplace_back();
  frame.joint = frame.own.get();
  return id;
}

void WorldFrames::set_joint_limits(ObjectId joint, double lower, double upper) {
  PlacedFrame* frame = kinematic_joint(state(), joint);
  if (frame == nullptr || frame->own == nullptr || frame->own->joint->axes.empty()) {
    throw InvalidInput(state().shown(joint) +
                       " has the limits of its file: those of joints that were added can be set");
  }
  if (!(lower <= upper)) {
    throw InvalidInput("the limits " + text(lower) + " and " + text(upper) +
                       " of a joint are not usable: the lower one "
                       "must not be above the upper one");
  }
  AxisDescription& axis = frame->own->joint->axes.front();
  axis.lower = lower;
  axis.upper = upper;
}

void WorldFrames::remove_dummy(ObjectId dummy) {
  const auto found = state().frames.find(dummy);
  if (!state().tree().contains(dummy) || found == state().frames.end() || !found->second.is_added) {
    throw WrongObject(state().shown(dummy) + " was not added to the scene: it cannot be removed on its own");
  }
  state().frames.erase(found);
  changing_tree(state()).remove(dummy);
}

FrameKind WorldFrames::kind(ObjectId frame) const {
  const Object& object = state().tree().at(frame);
  if (object.kind == ObjectKind::kFrame) return state().frames.at(frame).kind;
  throw WrongObject(state().shown(frame) + " is a " + std::string(kind_name(object.kind)) + ", not a frame");
}

ObjectId WorldFrames::link(ObjectId frame) const {
  kind(frame);  // throws
  return state().frames.at(frame).link;
}

const TreePlace* WorldFrames::place(ObjectId frame) const {
  kind(frame);  // throws
  const Object& object = state().tree().at(frame);
  if (state().frames.at(frame).is_added) return nullptr;
  const ObjectId model = state().tree().outermost_model_of(frame);
  const std::vector<FrameDescription>& described =
      model == kNoObject ? *state().scene_frames : state().model_of(model).description.frames;
  const auto& place = described[object.index].place;
  return place ? &*place : nullptr;
}

void WorldFrames::set_parent(ObjectId object, ObjectId parent) {
  changing_tree(state()).set_parent(object, parent);
  std::vector<ObjectId> open{object};
  while (!open.empty()) {
    const Object& next = state().tree().at(open.back());
    open.pop_back();
    const bool is_static = next.kind == ObjectKind::kLink && state().model_of(next.id).description.is_static;
    if (next.kind != ObjectKind::kFrame && !is_static) continue;
    const ObjectId link = link_that_carries(state(), next.parent);
    if (is_static) {
      attach_static(state(), next.id, link);
    } else {
      carry(state(), next.id, link);
    }
    open.insert(open.end(), next.children.begin(), next.children.end());
  }
}

void WorldFrames::set_alias(ObjectId object, std::string alias) {
  changing_tree(state()).set_alias(object, std::move(alias));
}

void forget_frames(WorldState& state, ObjectId model) {
  for (auto frame = state.frames.begin(); frame != state.frames.end();) {
    const bool is_carried =
        frame->second.link != kNoObject && state.tree().outermost_model_of(frame->second.link) == model;
    if (state.tree().outermost_model_of(frame->first) == model) {
      frame = state.frames.erase(frame);
    } else {
      if (is_carried) carry(state, frame->first, kNoObject);
      ++frame;
    }
  }
}

}  // namespace bubblesim
