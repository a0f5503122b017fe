// SPDX-License-Identifier: BSD-3-Clause
// Saves and restores the state of a world: see docs/adr/0030.
#include <algorithm>
#include <cstddef>
#include <string_view>
#include <typeinfo>
#include <vector>

#include "bubblesim/device.hpp"
#include "bubblesim/error.hpp"
#include "physics/motion/sleep.hpp"
#include "physics/ode/body_state.hpp"
#include "physics/world/state.hpp"
#include "scene/fnv1a.hpp"
#include "validation/limits.hpp"

namespace bubblesim {
namespace {

/// Transfers a pointer to a shape as its number.
void transfer_shape(StateArchive& archive, const WorldState& state, const Collider*& shape) {
  std::uint32_t number = shape == nullptr ? 0 : static_cast<std::uint32_t>(shape->number);
  archive(number);
  if (!archive.restores()) return;
  if (number >= state.colliders.size()) throw InvalidInput("the saved state names a shape that is not there");
  shape = state.colliders[number];
}

void transfer_memory(StateArchive& archive, const WorldState& state, ContactMemory& memory) {
  memory.pairs.resize(archive.count(memory.pairs.size()));
  memory.points.resize(archive.count(memory.points.size()));
  for (RememberedPair& pair : memory.pairs) {
    transfer_shape(archive, state, pair.first);
    transfer_shape(archive, state, pair.second);
    archive(pair.begin, pair.count, pair.age, pair.load, pair.load_before);
    const std::size_t points = memory.points.size();
    if (pair.count < 0 || pair.begin > points || static_cast<std::size_t>(pair.count) > points - pair.begin) {
      throw InvalidInput("the saved state names a contact that is not there");
    }
  }
  for (RememberedPoint& point : memory.points) {
    archive(point.position, point.direction, point.normal, point.friction, point.torque, point.limit);
  }
}

void transfer_touches(StateArchive& archive, WorldState& state) {
  std::vector<Touch>& touches = state.touches.all;
  touches.resize(archive.count(touches.size()));
  for (Touch& touch : touches) {
    transfer_shape(archive, state, touch.watched);
    transfer_shape(archive, state, touch.other);
    archive(touch.impulse, touch.substep);
    touch.points.resize(archive.count(touch.points.size()));
    for (ContactPoint& point : touch.points) archive(point.position, point.normal, point.depth, point.force);
  }
}

void transfer_planar_motor(StateArchive& archive, const WorldState& state, PlacedModel& model) {
  PlanarMotor& motor = model.planar_motor;
  bool used = motor.exists();
  archive(used);
  if (used != motor.exists()) motor = used ? make_planar_motor(state.ode.id(), model) : PlanarMotor();
  if (!used) return;
  auto [x, y, turning] = motor.velocity();
  archive(x, y, turning);
  if (archive.restores()) motor.set_velocity({x, y, turning});
}

void transfer_joint(StateArchive& archive, PlacedJoint& placed) {
  if (placed.joint != nullptr) archive(*placed.joint);
  if (placed.meter != nullptr) archive(*placed.meter);
  for (const auto& meter : placed.motor_meters) {
    if (meter != nullptr) archive(*meter);
  }
}

/// After the links.
void transfer_frame(StateArchive& archive, PlacedModel& model, std::size_t joint) {
  const PlacedJoint& placed = model.joints[joint];
  Pose in_parent = placed.in_parent;
  Pose in_child = placed.in_child;
  archive(in_parent, in_child);
  if (!archive.restores() || (in_parent == placed.in_parent && in_child == placed.in_child)) return;
  place_joint(model, joint, in_parent, in_child);
}

void transfer_model(StateArchive& archive, const WorldState& state, PlacedModel& model) {
  transfer_masses(archive, model);
  for (Link& link : model.links) {
    transfer_body(archive, link.body.get());
    archive(link.before);
    if (model.rest.may_sleep) archive(link.rest_pose);
  }
  for (Rotation& rotation : model.rotations) archive(rotation);
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    if (has_loose_frame(model, i)) transfer_frame(archive, model, i);
    transfer_joint(archive, model.joints[i]);
  }
  for (auto& [index, meter] : model.motion_meters) archive(meter);
  archive(model.rest.time, model.rest.group);
  transfer_planar_motor(archive, state, model);
}

/// Those of `models` and of the world, in their order.
std::vector<DeviceSlot*> devices_of(WorldState& state, const std::vector<ObjectId>& models) {
  std::vector<DeviceSlot*> devices;
  for (DeviceSlot& slot : state.devices) {
    if (slot.model == kNoObject || std::find(models.begin(), models.end(), slot.model) != models.end()) {
      devices.push_back(&slot);
    }
  }
  return devices;
}

std::uint64_t kind_of(const Device& device) {
  Fnv1a hash;
  hash.add(std::string_view(typeid(device).name()));
  return hash.value();
}

}  // namespace

void transfer(StateArchive& archive, Wrench& wrench) { archive(wrench.force, wrench.torque); }

void transfer_physics(StateArchive& archive, WorldState& state) {
  if (archive.restores()) {
    dJointGroupEmpty(state.ode.contact_joints.get());  // the contacts of the last substep
    state.contacts.found.clear();
    state.history.clear();
    state.lost_models.clear();
    state.diverged = true;  // until all of it is restored
  }
  archive.require(state.moving.all.size(), "number of moving models");
  archive.require(state.colliders.size(), "number of collision shapes");
  Vector3 gravity = state.gravity;
  archive(gravity);
  if (archive.restores()) {
    if (!within(gravity, kMaxGravity)) throw InvalidInput("the saved state has a gravity that is not usable");
    apply_gravity(state, gravity);
  }
  transfer_holds(archive, state);
  for (PlacedModel* model : state.moving.all) transfer_model(archive, state, *model);
  transfer_surfaces(archive, state);
  transfer_places(archive, state);
  transfer_frames(archive, state);
  transfer_memory(archive, state, state.contacts.memory);
  transfer_memory(archive, state, state.contacts.asleep);
  transfer_touches(archive, state);
  archive(state.wrenches, state.last_duration, state.touches.substeps, state.bottom, state.age);
  if (!archive.restores()) return;
  sort_by_sleep(state.moving, state.spaces, state.contacts);
  state.moving.is_any_commanded = true;  // it may have been before the state was saved
  state.diverged = false;
}

void World::transfer_layout(StateArchive& archive, const std::vector<ObjectId>& models) const {
  if (state_->interrupted) throw Diverged("the physics diverged; reset the world, then a state can be restored");
  for (const ObjectId model : models) {
    archive.require(state_->model_of(model).prepared->added_hash, "description of a model that was added");
  }
  const std::vector<DeviceSlot*> devices = devices_of(*state_, models);
  archive.require(devices.size(), "number of devices (add those of plugins and programs before the state is restored)");
  for (const DeviceSlot* slot : devices) {
    archive.require(static_cast<std::uint32_t>(slot->model), "model of a device");
    archive.require(kind_of(*slot->device), "kind of a device");
  }
}

void World::transfer_devices(StateArchive& archive, const std::vector<ObjectId>& models) {
  for (DeviceSlot* slot : devices_of(*state_, models)) {
    archive(slot->substeps, slot->ahead, slot->wrenches);
    slot->device->transfer(archive);
  }
}

void World::transfer(StateArchive& archive) {
  if (state_->interrupted || (state_->diverged && !archive.restores())) {
    throw Diverged("the physics diverged; reset the world, then a state can be saved or restored");
  }
  ode::prepare_this_thread();
  transfer_physics(archive, *state_);
  archive(state_->seed, state_->ode.random);
}

}  // namespace bubblesim
