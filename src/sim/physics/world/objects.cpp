// SPDX-License-Identifier: BSD-3-Clause
// Poses and velocities of a world's objects.
#include <cmath>
#include <string>

#include "bubblesim/error.hpp"
#include "bubblesim/world.hpp"
#include "check/checks.hpp"
#include "physics/world/state.hpp"
#include "scene/describe.hpp"

namespace bubblesim {
namespace {

/// The links of a model, or the link itself; throws for other objects and for static models.
std::vector<const Link*> moving_links(const World::State& state, ObjectId id) {
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
ObjectId carrier(const World::State& state, const Object& object) {
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

void check_velocity(const World::State& state, ObjectId object, const Twist& velocity) {
  if (within(velocity.linear, kMaxSpeed) && within(velocity.angular, kMaxSpeed)) return;
  throw InvalidInput(state.shown(object) + ": the velocity " + text(velocity.linear) + " m/s, " +
                     text(velocity.angular) + " rad/s is not usable: it must be finite and at most 1e6");
}

}  // namespace

Pose link_pose(const Link& link) {
  if (link.body == nullptr) return link.pose;
  Pose pose = body_pose(link.body.get());
  pose.position -= pose.orientation * link.centre_of_mass;
  return pose;
}

Pose World::pose(ObjectId object) const {
  const Object& found = state_->tree().at(object);
  const ObjectId link = carrier(*state_, found);
  const Pose base = link == kNoObject ? Pose() : link_pose(state_->link(link));
  switch (found.kind) {
    case ObjectKind::kModel:
      return base * state_->frame(object).in_canonical_link;
    case ObjectKind::kLink:
      return base;
    case ObjectKind::kJoint:
      return base * state_->model_of(object).joints[found.index].in_parent;
    case ObjectKind::kSensor: {
      const PlacedModel& model = state_->model_of(object);
      const Object& above = state_->tree().at(found.parent);
      const Pose& in_carrier = model.sensors[found.index];
      return above.kind == ObjectKind::kJoint ? base * model.joints[above.index].in_child * in_carrier
                                              : base * in_carrier;
    }
  }
  return base;
}

Twist World::velocity(ObjectId object) const {
  const ObjectId link = carrier(*state_, state_->tree().at(object));
  dBodyID body = link == kNoObject ? nullptr : state_->link(link).body.get();
  if (body == nullptr) return {};
  const Vector3 lever = pose(object).position - to_vector(dBodyGetPosition(body));
  const Twist of_body = body_velocity(body);
  return {of_body.linear + of_body.angular.cross(lever), of_body.angular};
}

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

void World::set_pose(ObjectId object, const Pose& pose) {
  const std::vector<const Link*> links = moving_links(*state_, object);
  if (!within(pose.position, kMaxDistance)) {
    throw InvalidInput(state_->shown(object) + ": the position " + text(pose.position) +
                       " is not usable: it must be finite and within 1e6 m of the origin");
  }
  if (!within(pose.orientation.norm() - 1, 1e-3)) {
    throw InvalidInput(state_->shown(object) + ": the orientation " + text(pose.orientation) +
                       " (x, y, z, w) is not usable: it must be a quaternion of length 1");
  }
  const Pose wanted(pose.position, pose.orientation.normalized());
  const Pose before = this->pose(object);
  wake(*state_);
  forget_contacts(*state_, state_->tree().outermost_model_of(object));
  for (const Link* link : links) {
    const Pose moved = wanted * (before.inverse() * link_pose(*link));
    const Vector3 centre = moved * link->centre_of_mass;
    dBodySetPosition(link->body.get(), centre.x(), centre.y(), centre.z());
    dBodySetQuaternion(link->body.get(), to_ode(moved.orientation).data());
  }
}

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

void World::set_state(ObjectId object, const Pose& pose, const Twist& velocity) {
  check_velocity(*state_, object, velocity);
  set_pose(object, pose);
  set_velocity(object, velocity);
}

std::vector<Light> World::link_lights() const {
  std::vector<Light> lights;
  for (const auto& model : state_->models) {
    for (std::size_t i = 0; i < model->links.size(); ++i) {
      for (Light light : model->description.links[i].lights) {
        const Pose pose = link_pose(model->links[i]);
        light.position = pose * light.position;
        light.direction = pose.orientation * light.direction;
        lights.push_back(std::move(light));
      }
    }
  }
  return lights;
}

}  // namespace bubblesim
