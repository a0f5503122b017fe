// SPDX-License-Identifier: BSD-3-Clause
// Poses and velocities of objects.
#include <cmath>
#include <string>

#include "bubblesim/error.hpp"
#include "bubblesim/world.hpp"
#include "check/checks.hpp"
#include "physics/motion/sleep.hpp"
#include "physics/world/state.hpp"
#include "scene/describe.hpp"

namespace bubblesim {
namespace {

/// The links of a model, or the link itself; throws for other objects and for static models.
std::vector<const Link*> moving_links(const WorldState& state, ObjectId id) {
  const Object& object = state.tree().at(id);
  if (object.kind != ObjectKind::kModel && object.kind != ObjectKind::kLink) {
    throw WrongObject(state.shown(id) + " is a " + std::string(kind_name(object.kind)) +
                      ": it cannot be moved on its own; move its link or model");
  }
  if (state.model_of(id).description.is_static) {
    throw WrongObject(state.shown(id) + " is static: it cannot be moved");
  }
  if (object.kind == ObjectKind::kLink) return {&state.link(id)};
  std::vector<const Link*> links;
  for (const ObjectId link : state.tree().parts(id, ObjectKind::kLink)) links.push_back(&state.link(link));
  return links;
}

/// The link that carries an object; kNoObject for objects that are fixed to the world.
ObjectId carrier(const WorldState& state, const Object& object) {
  switch (object.kind) {
    case ObjectKind::kModel:
      return state.frame(object.id).canonical_link;
    case ObjectKind::kLink:
      return object.id;
    case ObjectKind::kJoint:
      return state.model_of(object.id).joints[object.index].parent;
    case ObjectKind::kSensor:
      if (const Object& above = state.tree().at(object.parent); above.kind == ObjectKind::kJoint) {
        return state.model_of(object.id).joints[above.index].child;
      }
      return object.parent;
  }
  return kNoObject;
}

void check_velocity(const WorldState& state, ObjectId object, const Twist& velocity) {
  if (within(velocity.linear, kMaxSpeed) && within(velocity.angular, kMaxSpeed)) return;
  throw InvalidInput(state.shown(object) + ": the velocity " + text(velocity.linear) + " m/s, " +
                     text(velocity.angular) + " rad/s is not usable: it must be finite and at most 1e6");
}

}  // namespace

Pose pose_of(const WorldState& state, ObjectId object) {
  const Object& found = state.tree().at(object);
  const ObjectId link = carrier(state, found);
  const Pose base = link == kNoObject ? Pose() : link_pose(state.link(link));
  switch (found.kind) {
    case ObjectKind::kModel:
      return base * state.frame(object).in_canonical_link;
    case ObjectKind::kLink:
      return base;
    case ObjectKind::kJoint:
      return base * state.model_of(object).joints[found.index].in_parent;
    case ObjectKind::kSensor: {
      const PlacedModel& model = state.model_of(object);
      const Object& above = state.tree().at(found.parent);
      const Pose& in_carrier = model.sensors[found.index];
      return above.kind == ObjectKind::kJoint ? base * model.joints[above.index].in_child * in_carrier
                                              : base * in_carrier;
    }
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

void move_object(WorldState& state, ObjectId object, const Pose& pose) {
  const std::vector<const Link*> links = moving_links(state, object);
  if (!within(pose.position, kMaxDistance)) {
    throw InvalidInput(state.shown(object) + ": the position " + text(pose.position) +
                       " is not usable: it must be finite and within 1e6 m of the origin");
  }
  if (!within(pose.orientation.norm() - 1, 1e-3)) {
    throw InvalidInput(state.shown(object) + ": the orientation " + text(pose.orientation) +
                       " (x, y, z, w) is not usable: it must be a quaternion of length 1");
  }
  const Pose wanted(pose.position, pose.orientation.normalized());
  const Pose before = pose_of(state, object);
  wake(state.moving);
  forget_contacts(state, state.tree().outermost_model_of(object));
  for (const Link* link : links) {
    const Pose moved = wanted * (before.inverse() * link_pose(*link));
    const Vector3 centre = moved * link->centre_of_mass;
    dBodySetPosition(link->body.get(), centre.x(), centre.y(), centre.z());
    dBodySetQuaternion(link->body.get(), to_ode(moved.orientation).data());
  }
}

void World::set_pose(ObjectId object, const Pose& pose) { move_object(*state_, object, pose); }

void World::set_velocity(ObjectId object, const Twist& velocity) {
  const std::vector<const Link*> links = moving_links(*state_, object);
  check_velocity(*state_, object, velocity);
  const Vector3 origin = pose(object).position;
  for (const Link* link : links) dBodyEnable(link->body.get());
  for (const Link* link : links) {
    dBodyID body = link->body.get();
    const Vector3 linear = velocity.linear + velocity.angular.cross(to_vector(dBodyGetPosition(body)) - origin);
    dBodySetLinearVel(body, linear.x(), linear.y(), linear.z());
    dBodySetAngularVel(body, velocity.angular.x(), velocity.angular.y(), velocity.angular.z());
  }
}

void World::set_planar_velocity(ObjectId model, double x, double y, double turning) {
  const Object& object = state_->tree().at(model);
  if (object.kind != ObjectKind::kModel || object.parent != kNoObject) {
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
  dBodyEnable(body);
}

void World::set_state(ObjectId object, const Pose& pose, const Twist& velocity) {
  check_velocity(*state_, object, velocity);
  set_pose(object, pose);
  set_velocity(object, velocity);
}

}  // namespace bubblesim
