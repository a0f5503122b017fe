// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include "bubblesim/error.hpp"
#include "bubblesim/world_wrenches.hpp"
#include "physics/motion/sleep.hpp"
#include "physics/world/state.hpp"
#include "scene/describe.hpp"
#include "validation/limits.hpp"

namespace bubblesim {
namespace {

ObjectId pushed_link(const WorldState& state, ObjectId id) {
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

void check_vector(const WorldState& state, ObjectId id, const char* what, const Vector3& value, const char* unit,
                  double most) {
  if (within(value, most)) return;
  throw InvalidInput(state.shown(id) + ": the " + what + " " + text(value) + " " + unit +
                     " is not usable: it must be finite and at most " + text(most));
}

/// Where wrenches go that are applied now.
Wrenches& receiving(WorldState& state) { return state.updating == nullptr ? state.wrenches : state.updating->wrenches; }

}  // namespace

void WorldWrenches::check(ObjectId object, const Wrench& wrench, const std::optional<Vector3>& point) const {
  pushed_link(state(), object);
  check_vector(state(), object, "force", wrench.force, "N", kMaxEffort);
  check_vector(state(), object, "torque", wrench.torque, "N m", kMaxEffort);
  if (point) check_vector(state(), object, "point", *point, "m", kMaxDistance);
}

void WorldWrenches::apply(ObjectId object, const Wrench& wrench, const std::optional<Vector3>& point,
                          WrenchFrame frame) {
  check(object, wrench, point);
  const ObjectId link = pushed_link(state(), object);
  if (wrench.force == Vector3::Zero() && wrench.torque == Vector3::Zero()) return;  // does not wake it
  const Pose axes = frame == WrenchFrame::kObject ? pose_of(state(), object) : Pose();
  const Vector3 force = axes.orientation * wrench.force;
  Vector3 torque = axes.orientation * wrench.torque;
  if (point) {
    const Vector3 centre = to_vector(dBodyGetPosition(state().link(link).body.get()));
    torque += (axes * *point - centre).cross(force);
  }
  Wrench& sum = receiving(state())[link];
  sum.force += force;
  sum.torque += torque;
}

void WorldWrenches::clear(ObjectId object, bool force, bool torque) {
  Wrenches& wrenches = receiving(state());
  const auto found = wrenches.find(pushed_link(state(), object));
  if (found == wrenches.end()) return;
  if (force) found->second.force = Vector3::Zero();
  if (torque) found->second.torque = Vector3::Zero();
  if (force && torque) wrenches.erase(found);
}

void push_links(WorldState& state, const Wrenches& wrenches) {
  for (const auto& [link, wrench] : wrenches) {
    dBodyID body = state.link(link).body.get();
    command(state.moving, body);
    dBodyAddForce(body, wrench.force.x(), wrench.force.y(), wrench.force.z());
    dBodyAddTorque(body, wrench.torque.x(), wrench.torque.y(), wrench.torque.z());
  }
}

void forget_wrenches(WorldState& state) {
  const auto forget = [&](Wrenches& wrenches) {
    for (auto entry = wrenches.begin(); entry != wrenches.end();) {
      entry = !state.tree().contains(entry->first) ? wrenches.erase(entry) : std::next(entry);
    }
  };
  forget(state.wrenches);
  for (DeviceSlot& slot : state.devices) forget(slot.wrenches);
}

}  // namespace bubblesim
