// SPDX-License-Identifier: BSD-3-Clause
// Forces and torques from outside the physics.
#include <string>

#include "bubblesim/error.hpp"
#include "check/checks.hpp"
#include "physics/world/state.hpp"
#include "scene/describe.hpp"

namespace bubblesim {
namespace {

ObjectId pushed_link(const World::State& state, ObjectId id) {
  const Object& object = state.tree().at(id);
  if (object.kind != ObjectKind::kModel && object.kind != ObjectKind::kLink) {
    throw WrongObject(state.shown(id) + " is a " + std::string(kind_name(object.kind)) +
                      ": a wrench acts on a link or a model");
  }
  if (state.model_of(id).description.is_static) {
    throw WrongObject(state.shown(id) + " is static: it cannot be moved");
  }
  return object.kind == ObjectKind::kModel ? state.frame(id).canonical_link : id;
}

void check_vector(const World::State& state, ObjectId id, const char* what, const Vector3& value, const char* unit,
                  double most) {
  if (within(value, most)) return;
  throw InvalidInput(state.shown(id) + ": the " + what + " " + text(value) + " " + unit +
                     " is not usable: it must be finite and at most " + text(most));
}

/// Where wrenches go that are applied now.
Wrenches& receiving(World::State& state) {
  return state.updating == nullptr ? state.wrenches : state.updating->wrenches;
}

}  // namespace

void World::check_wrench(ObjectId object, const Wrench& wrench, const std::optional<Vector3>& point) const {
  pushed_link(*state_, object);
  check_vector(*state_, object, "force", wrench.force, "N", kMaxEffort);
  check_vector(*state_, object, "torque", wrench.torque, "N m", kMaxEffort);
  if (point) check_vector(*state_, object, "point", *point, "m", kMaxDistance);
}

void World::apply_wrench(ObjectId object, const Wrench& wrench, const std::optional<Vector3>& point,
                         WrenchFrame frame) {
  check_wrench(object, wrench, point);
  const ObjectId link = pushed_link(*state_, object);
  if (wrench.force == Vector3::Zero() && wrench.torque == Vector3::Zero()) return;  // does not wake it
  const Pose axes = frame == WrenchFrame::kObject ? pose(object) : Pose();
  const Vector3 force = axes.orientation * wrench.force;
  Vector3 torque = axes.orientation * wrench.torque;
  if (point) {
    const Vector3 centre = to_vector(dBodyGetPosition(state_->link(link).body.get()));
    torque += (axes * *point - centre).cross(force);
  }
  Wrench& sum = receiving(*state_)[link];
  sum.force += force;
  sum.torque += torque;
}

void World::clear_wrench(ObjectId object, bool force, bool torque) {
  Wrenches& wrenches = receiving(*state_);
  const auto found = wrenches.find(pushed_link(*state_, object));
  if (found == wrenches.end()) return;
  if (force) found->second.force = Vector3::Zero();
  if (torque) found->second.torque = Vector3::Zero();
  if (force && torque) wrenches.erase(found);
}

void push_links(const World::State& state, const Wrenches& wrenches) {
  for (const auto& [link, wrench] : wrenches) {
    dBodyID body = state.link(link).body.get();
    dBodyEnable(body);
    dBodyAddForce(body, wrench.force.x(), wrench.force.y(), wrench.force.z());
    dBodyAddTorque(body, wrench.torque.x(), wrench.torque.y(), wrench.torque.z());
  }
}

void forget_wrenches(World::State& state) {
  const auto forget = [&](Wrenches& wrenches) {
    for (auto entry = wrenches.begin(); entry != wrenches.end();) {
      entry = !state.tree().contains(entry->first) ? wrenches.erase(entry) : std::next(entry);
    }
  };
  forget(state.wrenches);
  for (DeviceSlot& slot : state.devices) forget(slot.wrenches);
}

}  // namespace bubblesim
