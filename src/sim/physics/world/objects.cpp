// SPDX-License-Identifier: BSD-3-Clause
// Poses and velocities of objects.
#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "bubblesim/error.hpp"
#include "bubblesim/world.hpp"
#include "physics/motion/sleep.hpp"
#include "physics/world/state.hpp"
#include "scene/describe.hpp"
#include "validation/limits.hpp"

namespace bubblesim {
namespace {

/// Whether a link has a shape that cannot be moved: an infinite plane.
bool is_infinite(const WorldState& state, ObjectId link) {
  const PlacedModel& model = state.model_of(link);
  if (!model.description.is_static) return false;
  return std::any_of(model.colliders.begin(), model.colliders.end(), [&](const Collider& collider) {
    return collider.link->object == link && std::holds_alternative<Plane>(collider.geometry);
  });
}

/// Whether a sensor may be moved in its link: it neither belongs to a joint, nor measures the motion of a body.
bool is_loose(const WorldState& state, const Object& sensor) {
  const bool is_of_link = state.tree().at(sensor.carrier).kind == ObjectKind::kLink;
  return is_of_link && state.model_of(sensor.id).motion_meters.count(sensor.index) == 0;
}

/// Whether a joint may be moved between its links.
bool is_loose_joint(const WorldState& state, const Object& joint) {
  return is_hinge(state.model_of(joint.id), joint.index);
}

/// What moves with an object that is set to a pose.
struct Movers {
  std::set<ObjectId> links;
  std::vector<ObjectId> frames;
  std::vector<ObjectId> sensors;
  std::vector<ObjectId> joints;
};

/// The objects with what is below them in the tree, and below the links of each model among these.
Movers movers(const WorldState& state, std::vector<ObjectId> open) {
  Movers found;
  std::set<ObjectId> passed;
  while (!open.empty()) {
    const Object& object = state.tree().at(open.back());
    open.pop_back();
    if (!passed.insert(object.id).second) continue;
    open.insert(open.end(), object.children.begin(), object.children.end());
    if (object.kind == ObjectKind::kFrame) found.frames.push_back(object.id);
    if (object.kind == ObjectKind::kModel) {
      const std::vector<ObjectId> links = state.tree().parts(object.id, ObjectKind::kLink);
      open.insert(open.end(), links.begin(), links.end());
    }
    if (object.kind == ObjectKind::kLink && !is_infinite(state, object.id)) found.links.insert(object.id);
    if (object.kind == ObjectKind::kSensor && is_loose(state, object)) found.sensors.push_back(object.id);
    if (object.kind == ObjectKind::kJoint && is_loose_joint(state, object)) found.joints.push_back(object.id);
  }
  return found;
}

/// Throws for objects that cannot be set to a pose.
void check_movable(const WorldState& state, ObjectId id) {
  const Object& object = state.tree().at(id);
  if (object.kind == ObjectKind::kFrame) {
    if (state.frames.at(id).kind != FrameKind::kShape || state.frames.at(id).link == kNoObject) return;
    throw WrongObject(state.shown(id) + " is a part of " + state.shown(state.frames.at(id).link) +
                      ": it cannot be moved on its own; move that");
  }
  if (object.kind == ObjectKind::kSensor && is_loose(state, object)) return;
  if (object.kind == ObjectKind::kJoint && is_loose_joint(state, object)) return;
  if (object.kind != ObjectKind::kModel && object.kind != ObjectKind::kLink) {
    throw WrongObject(state.shown(id) + " is a " + std::string(kind_name(object.kind)) +
                      ": it cannot be moved on its own; move its link or model");
  }
  std::vector<ObjectId> links{id};
  if (object.kind == ObjectKind::kModel) links = state.tree().parts(id, ObjectKind::kLink);
  for (const ObjectId link : links) {
    if (is_infinite(state, link)) throw WrongObject(state.shown(id) + " has an infinite plane: it cannot be moved");
  }
}

/// Throws for objects that have no velocity of their own.
void check_has_velocity(const WorldState& state, ObjectId id) {
  const Object& object = state.tree().at(id);
  if (object.kind != ObjectKind::kModel && object.kind != ObjectKind::kLink) {
    throw WrongObject(state.shown(id) + " is a " + std::string(kind_name(object.kind)) +
                      ": it cannot be moved on its own; move its link or model");
  }
  if (state.model_of(id).description.is_static) {
    throw WrongObject(state.shown(id) + " is static: it cannot be moved by a velocity");
  }
}

void check_velocity(const WorldState& state, ObjectId object, const Twist& velocity) {
  if (within(velocity.linear, kMaxSpeed) && within(velocity.angular, kMaxSpeed)) return;
  throw InvalidInput(state.shown(object) + ": the velocity " + text(velocity.linear) + " m/s, " +
                     text(velocity.angular) + " rad/s is not usable: it must be finite and at most 1e6");
}

/// The world's for no link.
Pose pose_of_link(const WorldState& state, ObjectId link) {
  return link == kNoObject ? Pose() : link_pose(state.link(link));
}

}  // namespace

ObjectId carrier(const WorldState& state, const Object& object) {
  switch (object.kind) {
    case ObjectKind::kModel:
      return state.frame(object.id).canonical_link;
    case ObjectKind::kLink:
      return object.id;
    case ObjectKind::kJoint:
      return state.model_of(object.id).joints[object.index].parent;
    case ObjectKind::kSensor:
      if (const Object& above = state.tree().at(object.carrier); above.kind == ObjectKind::kJoint) {
        return state.model_of(object.id).joints[above.index].child;
      }
      return object.carrier;
    case ObjectKind::kFrame:
      return state.frames.at(object.id).link;
  }
  return kNoObject;
}

Pose pose_of(const WorldState& state, ObjectId object) {
  const Object& found = state.tree().at(object);
  const ObjectId link = carrier(state, found);
  const Pose base = pose_of_link(state, link);
  switch (found.kind) {
    case ObjectKind::kModel:
      return base * state.frame(object).in_canonical_link;
    case ObjectKind::kLink:
      return base;
    case ObjectKind::kJoint:
      return base * state.model_of(object).joints[found.index].in_parent;
    case ObjectKind::kSensor: {
      const PlacedModel& model = state.model_of(object);
      const Object& above = state.tree().at(found.carrier);
      const Pose& in_carrier = model.sensors[found.index];
      return above.kind == ObjectKind::kJoint ? base * model.joints[above.index].in_child * in_carrier
                                              : base * in_carrier;
    }
    case ObjectKind::kFrame:
      return base * state.frames.at(object).pose;
  }
  return base;
}

Twist velocity_of(const WorldState& state, ObjectId object) {
  const ObjectId link = carrier(state, state.tree().at(object));
  dBodyID body = link == kNoObject ? nullptr : state.link(link).body.get();
  if (body == nullptr) return {};
  const Vector3 lever = pose_of(state, object).position - to_vector(dBodyGetPosition(body));
  const Twist of_body = body_velocity(body);
  return {of_body.linear + of_body.angular.cross(lever), of_body.angular};
}

Pose World::pose(ObjectId object) const { return pose_of(*state_, object); }

Twist World::velocity(ObjectId object) const { return velocity_of(*state_, object); }

Vector3 World::acceleration(ObjectId object) const {
  const ObjectId id = carrier(*state_, state_->tree().at(object));
  if (id == kNoObject || state_->last_duration == 0) return {};
  const Link& link = state_->link(id);
  dBodyID body = link.body.get();
  if (body == nullptr) return {};
  const Twist now = body_velocity(body);
  const Vector3 lever = pose(object).position - to_vector(dBodyGetPosition(body));
  const Vector3 of_centre = (now.linear - link.before.linear) / state_->last_duration;
  const Vector3 angular = (now.angular - link.before.angular) / state_->last_duration;
  // Acceleration of a point of a rigid body: that of its centre, the Euler and the centripetal acceleration.
  return of_centre + angular.cross(lever) + now.angular.cross(now.angular.cross(lever));
}

namespace {

/// Without rounding errors in the length of the quaternion, which a later motion would multiply.
Pose normalized(const Pose& pose) { return {pose.position, pose.orientation.normalized()}; }

/// What is fixed to the world stays where it was put.
void anchor_moved(const WorldState& state, PlacedModel& model, const std::set<ObjectId>& links) {
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const PlacedJoint& joint = model.joints[i];
    if (!is_anchor(model, i) || links.count(joint.child) == 0) continue;
    place_joint(model, i, normalized(link_pose(state.link(joint.child)) * joint.in_child), joint.in_child);
  }
}

/// A joint that moves between its links, and both of its sides in the world, where they are to be.
struct MovedJoint {
  ObjectId joint;
  Pose frame;
  Pose moving_frame;
};

/// The joints that move otherwise than their parents. What they are turned by stays.
std::vector<MovedJoint> moved_joints(const WorldState& state, const Movers& moving, const Pose& motion) {
  std::vector<MovedJoint> found;
  for (const ObjectId id : moving.joints) {
    const PlacedJoint& placed = state.model_of(id).joints[state.tree().at(id).index];
    if (moving.links.count(placed.parent) > 0) continue;
    const Pose moving_frame = link_pose(state.link(placed.child)) * placed.in_child;
    found.push_back({id, motion * pose_of(state, id), motion * moving_frame});
  }
  return found;
}

void place_joints(WorldState& state, const std::vector<MovedJoint>& joints) {
  for (const MovedJoint& moved : joints) {
    PlacedModel& model = state.model_of(moved.joint);
    const std::size_t index = state.tree().at(moved.joint).index;
    const PlacedJoint& placed = model.joints[index];
    place_joint(model, index, normalized(pose_of_link(state, placed.parent).inverse() * moved.frame),
                normalized(link_pose(state.link(placed.child)).inverse() * moved.moving_frame));
  }
}

/// Moves all from where they are relative to `before` to the same place relative to `wanted`.
void move(WorldState& state, const Movers& moving, const Pose& before, const Pose& wanted) {
  for (const ObjectId frame : moving.frames) {
    PlacedFrame& placed = state.frames.at(frame);
    if (moving.links.count(placed.link) > 0) continue;  // it moves along
    const Pose moved = wanted * (before.inverse() * frame_pose(state, placed));
    placed.pose = normalized(placed.link == kNoObject ? moved : link_pose(state.link(placed.link)).inverse() * moved);
  }
  for (const ObjectId id : moving.sensors) {
    const Object& sensor = state.tree().at(id);
    if (moving.links.count(sensor.carrier) > 0) continue;
    const Pose moved = wanted * (before.inverse() * pose_of(state, id));
    state.model_of(id).sensors[sensor.index] = normalized(link_pose(state.link(sensor.carrier)).inverse() * moved);
  }
  const std::vector<MovedJoint> joints = moved_joints(state, moving, wanted * before.inverse());
  if (moving.links.empty() && joints.empty()) return;
  wake_all(state);
  std::set<ObjectId> models;
  for (const ObjectId id : moving.links) models.insert(state.tree().outermost_model_of(id));
  for (const ObjectId model : models) forget_contacts(state, model);
  for (const ObjectId id : moving.links) {
    const Link& link = state.link(id);
    const Pose moved = wanted * (before.inverse() * link_pose(link));
    if (link.body == nullptr) {
      place_static(state, id, normalized(moved));
      continue;
    }
    const Vector3 centre = moved * link.centre_of_mass;
    dBodySetPosition(link.body.get(), centre.x(), centre.y(), centre.z());
    dBodySetQuaternion(link.body.get(), to_ode(moved.orientation).data());
  }
  for (const ObjectId id : models) anchor_moved(state, state.model_of(id), moving.links);
  place_joints(state, joints);
  hold_moved(state, moving.links);
  // Those that are carried keep their new place on what carries them, which may have moved, too.
  for (const ObjectId id : moving.links) {
    if (state.link(id).body == nullptr) attach_static(state, id, state.link(id).carrier);
  }
}

void check_pose(const WorldState& state, ObjectId object, const Pose& pose) {
  if (!within(pose.position, kMaxDistance)) {
    throw InvalidInput(state.shown(object) + ": the position " + text(pose.position) +
                       " is not usable: it must be finite and within 1e6 m of the origin");
  }
  if (!within(pose.orientation.norm() - 1, 1e-3)) {
    throw InvalidInput(state.shown(object) + ": the orientation " + text(pose.orientation) +
                       " (x, y, z, w) is not usable: it must be a quaternion of length 1");
  }
}

}  // namespace

void move_object(WorldState& state, ObjectId object, const Pose& pose) {
  check_movable(state, object);
  check_pose(state, object, pose);
  move(state, movers(state, {object}), pose_of(state, object), {pose.position, pose.orientation.normalized()});
}

void move_children(WorldState& state, ObjectId parent, const Pose& before, const Pose& wanted) {
  move(state, movers(state, state.tree().at(parent).children), before, wanted);
}

void move_links(WorldState& state, const std::vector<ObjectId>& links, const Pose& motion) {
  Movers others = movers(state, links);
  others.joints.clear();  // their parents move
  for (const ObjectId link : links) {
    check_movable(state, link);
    check_pose(state, link, motion * pose_of(state, link));
  }
  // Frames first: they may be carried by links.
  std::vector<ObjectId> frames;
  for (const ObjectId frame : others.frames) {
    if (others.links.count(state.frames.at(frame).link) == 0) frames.push_back(frame);
  }
  std::vector<ObjectId> sensors;
  for (const ObjectId sensor : others.sensors) {
    if (others.links.count(state.tree().at(sensor).carrier) == 0) sensors.push_back(sensor);
  }
  move(state, {{}, frames, sensors, {}}, Pose(), motion);
  for (const ObjectId link : links) {
    const Pose before = pose_of(state, link);
    const Pose wanted = motion * before;
    move(state, {{link}, {}, {}, {}}, before, {wanted.position, wanted.orientation.normalized()});
    others.links.erase(link);
  }
  others.frames.clear();
  others.sensors.clear();
  move(state, others, Pose(), motion);
}

void World::set_pose(ObjectId object, const Pose& pose) { move_object(*state_, object, pose); }

void World::set_velocity(ObjectId object, const Twist& velocity) {
  check_has_velocity(*state_, object);
  check_velocity(*state_, object, velocity);
  const Vector3 origin = pose(object).position;
  const std::set<ObjectId> links = movers(*state_, {object}).links;
  for (const ObjectId link : links) {
    dBodyID body = state_->link(link).body.get();
    if (body == nullptr) continue;
    command(state_->moving, body);
    const Vector3 linear = velocity.linear + velocity.angular.cross(to_vector(dBodyGetPosition(body)) - origin);
    dBodySetLinearVel(body, linear.x(), linear.y(), linear.z());
    dBodySetAngularVel(body, velocity.angular.x(), velocity.angular.y(), velocity.angular.z());
  }
}

void World::set_planar_velocity(ObjectId model, double x, double y, double turning) {
  const Object& object = state_->tree().at(model);
  if (!object.is_outermost_model()) {
    throw WrongObject(state_->shown(model) + " is a " + std::string(kind_name(object.kind)) +
                      ": the planar velocity can be set for outermost models only");
  }
  PlacedModel& placed = state_->model_of(model);
  if (placed.description.is_static) throw WrongObject(state_->shown(model) + " is static: it cannot be moved");
  if (!within(x, kMaxSpeed) || !within(y, kMaxSpeed) || !within(turning, kMaxSpeed)) {
    throw InvalidInput(state_->shown(model) + ": the planar velocity must be finite and at most 1e6");
  }
  dBodyID body = state_->link(placed.frame.canonical_link).body.get();
  if (!placed.planar_motor.exists()) placed.planar_motor = make_planar_motor(state_->ode.id(), placed);
  // ODE's motor moves the centre of mass, which moves in a circle around the model's origin.
  const Vector3 arm = to_vector(dBodyGetPosition(body)) - pose(model).position;
  placed.planar_motor.set_velocity({x - turning * arm.y(), y + turning * arm.x(), turning});
  command(state_->moving, body);
}

void World::set_state(ObjectId object, const Pose& pose, const Twist& velocity) {
  check_has_velocity(*state_, object);
  check_velocity(*state_, object, velocity);
  set_pose(object, pose);
  set_velocity(object, velocity);
}

}  // namespace bubblesim
