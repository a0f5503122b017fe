// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include "bubblesim/error.hpp"
#include "bubblesim/world_measurements.hpp"
#include "physics/world/state.hpp"

namespace bubblesim {

void clear_meters(WorldState& state) {
  state.touches.clear();
  for (PlacedModel* model : state.moving.awake) {
    for (auto& [index, meter] : model->motion_meters) meter.clear();
    for (const PlacedJoint& placed : model->joints) {
      if (placed.meter != nullptr) placed.meter->clear();
      for (const auto& meter : placed.motor_meters) {
        if (meter != nullptr) meter->clear();
      }
    }
  }
}

std::vector<Contact> WorldMeasurements::contacts(ObjectId link) const {
  if (state().tree().at(link).kind != ObjectKind::kLink)
    throw WrongObject(state().shown(link) + " is a " + std::string(kind_name(state().tree().at(link).kind)) +
                      ", not a link");
  std::vector<Contact> contacts;
  for (const Touch& touch : state().touches.all) {
    if (touch.watched->link->object != link) continue;
    contacts.push_back({touch.watched->name, touch.other->link->object, touch.other->name,
                        touch.impulse / state().last_duration, touch.points});
  }
  return contacts;
}

std::vector<TouchPoint> WorldMeasurements::contact_points() const {
  std::vector<TouchPoint> points;
  for (const ContactMemory* memory : {&state().contacts.memory, &state().contacts.asleep}) {
    for (const RememberedPair& pair : memory->pairs) {
      for (std::size_t i = pair.begin; i < pair.begin + static_cast<std::size_t>(pair.count); ++i) {
        const RememberedPoint& point = memory->points[i];
        points.push_back({pair.first->link->object, pair.second->link->object, point.position, point.direction,
                          point.normal, point.direction * point.normal + point.friction});
      }
    }
  }
  return points;
}

Wrench WorldMeasurements::joint_wrench(ObjectId joint) const {
  const Object& object = state().tree().at(joint);
  const PlacedJoint* placed =
      object.kind == ObjectKind::kJoint ? &state().model_of(joint).joints[object.index] : nullptr;
  if (placed != nullptr && placed->joint == nullptr) return {};  // of a static model
  if (placed == nullptr || placed->meter == nullptr) {
    throw WrongObject(state().shown(joint) + " is not a moving joint with a force-torque sensor");
  }
  if (state().last_duration == 0) return {};
  return {placed->meter->impulse().force / state().last_duration,
          placed->meter->impulse().torque / state().last_duration};
}

Wrench WorldMeasurements::sensor_wrench(ObjectId sensor) const {
  const Object& object = state().tree().at(sensor);
  const PlacedModel& model = state().model_of(sensor);
  for (const PlacedJoint& placed : model.joints) {
    if (placed.object != object.carrier || placed.meter == nullptr) continue;
    if (const std::optional<Wrench> measured = placed.meter->of_sensor(object.index)) return *measured;
  }
  return {};  // of a static model
}

Inertial WorldMeasurements::sensor_motion(ObjectId sensor) const {
  const auto& meters = state().model_of(sensor).motion_meters;
  const auto found = meters.find(state().tree().at(sensor).index);
  if (found != meters.end() && found->second.has_value()) {
    return {found->second.angular_velocity(), found->second.specific_force()};
  }
  const Quaternion axes = pose_of(state(), sensor).orientation;
  return {axes.conjugate() * velocity_of(state(), sensor).angular, axes.conjugate() * -state().gravity};
}

}  // namespace bubblesim
