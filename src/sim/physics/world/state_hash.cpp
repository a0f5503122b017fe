// SPDX-License-Identifier: BSD-3-Clause
// The hash of a world's state.
#include <string>
#include <string_view>

#include "bubblesim/device.hpp"
#include "physics/motion/sleep.hpp"
#include "physics/world/state.hpp"
#include "scene/fnv1a.hpp"

namespace bubblesim {
namespace {

void add_wrenches(Fnv1a& hash, const Wrenches& wrenches) {
  for (const auto& [link, wrench] : wrenches) {
    const double values[] = {wrench.force.x(),  wrench.force.y(),  wrench.force.z(),
                             wrench.torque.x(), wrench.torque.y(), wrench.torque.z()};
    hash.add(static_cast<std::uint64_t>(link));
    hash.add(values, 6);
  }
}

void add_scheduled(Fnv1a& hash, const DeviceSlot& slot) {
  const double schedule[] = {slot.period, slot.ahead};
  hash.add(schedule, 2);
  hash.add(static_cast<std::uint64_t>(slot.substeps));
  std::string saved;
  StateArchive archive(saved);
  slot.device->transfer(archive);
  hash.add(std::string_view(saved));
  add_wrenches(hash, slot.wrenches);
}

void add_planar_motor(Fnv1a& hash, const PlanarMotor& motor) {
  if (motor.exists()) hash.add(motor.velocity().data(), 3);
}

}  // namespace

void add_pose(Fnv1a& hash, const Pose& pose) {
  const Vector3& p = pose.position;
  const Quaternion& q = pose.orientation;
  const double values[] = {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()};
  hash.add(values, 7);
}

std::uint64_t World::state_hash() const {
  Fnv1a hash;
  for (const auto& model : state_->models) {
    for (const Link& link : model->links) {
      dBodyID body = link.body.get();
      if (body == nullptr) continue;
      hash.add(dBodyGetPosition(body), 3);
      hash.add(dBodyGetQuaternion(body), 4);
      hash.add(dBodyGetLinearVel(body), 3);
      hash.add(dBodyGetAngularVel(body), 3);
      hash.add(static_cast<std::uint64_t>(dBodyIsEnabled(body)));
    }
    for (const Rotation& rotation : model->rotations) {
      const double ahead[] = {rotation.ahead().x(), rotation.ahead().y(), rotation.ahead().z()};
      hash.add(ahead, 3);
    }
    add_planar_motor(hash, model->planar_motor);
    add_rest(hash, *model);
  }
  for (const auto& model : state_->models) {
    for (std::size_t i = 0; i < model->joints.size(); ++i) {
      const PlacedJoint& placed = model->joints[i];
      if (is_anchor(*model, i)) add_pose(hash, placed.in_parent);
      if (is_hinge(*model, i) && placed.is_elsewhere()) {  // else those of the file, which differ in the last bits
        add_pose(hash, placed.in_parent);
        add_pose(hash, placed.in_child);
      }
      for (int axis = 0; placed.joint && axis < placed.joint->axis_count(); ++axis) {
        const double targets[] = {placed.joint->target_position(axis), placed.joint->target_velocity(axis),
                                  placed.joint->target_effort(axis), placed.joint->axis(axis).max_force,
                                  placed.joint->motor_gain(axis)};
        hash.add(targets, 5);
        hash.add(static_cast<std::uint64_t>(placed.joint->axis(axis).motor));
      }
    }
  }
  state_->contacts.memory.add_to(hash);
  state_->contacts.asleep.add_to(hash);
  add_wrenches(hash, state_->wrenches);
  for (const DeviceSlot& slot : state_->devices) add_scheduled(hash, slot);
  add_frames(hash, *state_);
  add_places(hash, *state_);
  add_surfaces(hash, *state_);
  add_holds(hash, *state_);
  hash.add(state_->seed);
  hash.add(static_cast<std::uint64_t>(state_->ode.random));
  return hash.value();
}

}  // namespace bubblesim
