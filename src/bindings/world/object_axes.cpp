// SPDX-License-Identifier: BSD-3-Clause
#include "world/object_axes.hpp"

#include <variant>

namespace bubblesim::bindings {
namespace {

// Maps z to x, x to y and y to z.
const Quaternion kLookingAlongZ(0.5, 0.5, 0.5, 0.5);

Quaternion joint_axes(const World& world, ObjectId joint) {
  const JointDescription& description = world.joints().description(joint);
  // The second axis of a joint is an object below the joint.
  const bool is_second = world.tree().at(joint).is_second_axis();
  if (description.axes.empty()) return Quaternion();
  return turn_from_z((is_second ? description.axes.back() : description.axes.front()).direction);
}

bool looks_along_an_axis(const SensorDescription& sensor) {
  return sensor.kind.holds<SonarDescription>() || sensor.kind.holds<CameraDescription>();
}

}  // namespace

Quaternion object_axes(const World& world, ObjectId object) {
  const ObjectKind kind = world.tree().at(object).kind;
  if (kind != ObjectKind::kJoint && kind != ObjectKind::kSensor) return Quaternion();
  if (world.models().description(object).axes != AxisConvention::kCoppeliaSim) return Quaternion();
  if (kind == ObjectKind::kJoint) return joint_axes(world, object);
  return looks_along_an_axis(world.models().sensor_description(object)) ? kLookingAlongZ : Quaternion();
}

}  // namespace bubblesim::bindings
