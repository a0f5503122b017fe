// SPDX-License-Identifier: BSD-3-Clause
#include "run/quantity_kinds.hpp"

#include <algorithm>
#include <initializer_list>

namespace bubblesim {
namespace {

using Kind = Quantities::Kind;
using Place = Kind::Place;
using Shape = Kind::Shape;

Vector3 take_vector(Row& row) {
  const double x = row.take();
  const double y = row.take();
  return {x, y, row.take()};
}
Pose take_pose(Row& row) {
  const Vector3 position = take_vector(row);
  const Vector3 v = take_vector(row);
  return {position, Quaternion(row.take(), v.x(), v.y(), v.z())};
}
Twist take_twist(Row& row) {
  const Vector3 linear = take_vector(row);
  return {linear, take_vector(row)};
}

Pose pose_of(const World& world, const Place& place) {
  const Pose pose = world.pose(place.object);
  return place.relative_to == kNoObject ? pose : world.pose(place.relative_to).inverse() * pose;
}

/// Relative: the difference of the velocities, in the axes of the other object.
Twist velocity_of(const World& world, const Place& place) {
  Twist twist = world.velocity(place.object);
  if (place.relative_to == kNoObject) return twist;
  const Quaternion axes = world.pose(place.relative_to).orientation;
  const Twist other = world.velocity(place.relative_to);
  return {axes.conjugate() * (twist.linear - other.linear), axes.conjugate() * (twist.angular - other.angular)};
}

/// 0: a single number.
template <std::size_t kCount>
Shape of_any(const World&, ObjectId) {
  return kCount == 0 ? Sizes{} : Sizes{kCount};
}

bool moves(const World& world, ObjectId object, std::initializer_list<ObjectKind> kinds) {
  const ObjectKind kind = world.tree().at(object).kind;
  return std::find(kinds.begin(), kinds.end(), kind) != kinds.end() && !world.models().description(object).is_static;
}

/// Of an axis of a moving joint.
Shape of_axis(const World& world, ObjectId object) {
  const Object& found = world.tree().at(object);
  if (found.kind != ObjectKind::kJoint || world.joints().axes(object) == 0) return std::nullopt;
  return Sizes{};
}

template <std::size_t kCount>
Shape of_body(const World& world, ObjectId object) {
  if (!moves(world, object, {ObjectKind::kModel, ObjectKind::kLink})) return std::nullopt;
  return Sizes{kCount};
}

Shape of_mass(const World& world, ObjectId object) {
  if (!moves(world, object, {ObjectKind::kModel, ObjectKind::kLink})) return std::nullopt;
  return Sizes{};
}

/// Of links and models with collisions.
Shape of_friction(const World& world, ObjectId object) {
  const ObjectKind kind = world.tree().at(object).kind;
  if (kind != ObjectKind::kModel && kind != ObjectKind::kLink) return std::nullopt;
  try {
    world.properties().friction(object);
  } catch (const WrongObject&) {
    return std::nullopt;
  }
  return Sizes{};
}

Shape of_moving_model(const World& world, ObjectId object) {
  if (!moves(world, object, {ObjectKind::kModel}) || !world.tree().at(object).is_outermost_model()) return std::nullopt;
  return Sizes{3};
}

Shape of_any_sensor(const World& world, ObjectId object) {
  if (world.tree().at(object).kind != ObjectKind::kSensor) return std::nullopt;
  return Sizes{};
}

template <double (WorldJoints::*kGet)(ObjectId, int) const>
void observe_axis(Simulation& simulation, const Place& place, Row& row) {
  row.put((simulation.world().joints().*kGet)(place.object, 0));
}

template <void (WorldJoints::*kSet)(ObjectId, double, int)>
void command_axis(Simulation& simulation, ObjectId joint, Row& row) {
  (simulation.world().joints().*kSet)(joint, row.take(), 0);
}

template <double (WorldProperties::*kGet)(ObjectId) const>
void observe_object(Simulation& simulation, const Place& place, Row& row) {
  row.put((simulation.world().properties().*kGet)(place.object));
}

template <void (WorldProperties::*kSet)(ObjectId, double)>
void command_object(Simulation& simulation, ObjectId object, Row& row) {
  (simulation.world().properties().*kSet)(object, row.take());
}

void command_velocity_of_model(Simulation& simulation, ObjectId model, Row& row) {
  const Vector3 velocity = take_vector(row);
  simulation.world().set_planar_velocity(model, velocity.x(), velocity.y(), velocity.z());
}

/// Quantities of the motion of any object.
std::vector<Kind> motions() {
  return {
      {"pose", of_any<7>,
       [](Simulation& s, const Place& place, Row& row) {
         const Pose pose = pose_of(s.world(), place);
         row.put(pose.position);
         row.put(pose.orientation);
       },
       [](Simulation& s, ObjectId object, Row& row) { s.world().set_pose(object, take_pose(row)); }, true},
      {"position", of_any<3>,
       [](Simulation& s, const Place& place, Row& row) { row.put(pose_of(s.world(), place).position); },
       [](Simulation& s, ObjectId object, Row& row) {
         s.world().set_pose(object, {take_vector(row), s.world().pose(object).orientation});
       },
       true},
      {"orientation", of_any<4>,
       [](Simulation& s, const Place& place, Row& row) { row.put(pose_of(s.world(), place).orientation); }, nullptr,
       true},
      {"yaw", of_any<0>,
       [](Simulation& s, const Place& place, Row& row) { row.put(to_rpy(pose_of(s.world(), place).orientation).z()); },
       [](Simulation& s, ObjectId object, Row& row) {
         s.world().set_pose(object, {s.world().pose(object).position, from_rpy(0, 0, row.take())});
       },
       true},
      {"velocity", of_any<6>,
       [](Simulation& s, const Place& place, Row& row) {
         const Twist twist = velocity_of(s.world(), place);
         row.put(twist.linear);
         row.put(twist.angular);
       },
       [](Simulation& s, ObjectId object, Row& row) { s.world().set_velocity(object, take_twist(row)); }, true},
      {"linear_velocity", of_any<3>,
       [](Simulation& s, const Place& place, Row& row) { row.put(velocity_of(s.world(), place).linear); }, nullptr,
       true},
      {"angular_velocity", of_any<3>,
       [](Simulation& s, const Place& place, Row& row) { row.put(velocity_of(s.world(), place).angular); }, nullptr,
       true},
  };
}

/// Quantities of joints, and pushes.
std::vector<Kind> efforts() {
  return {
      {"joint_position", of_axis, observe_axis<&WorldJoints::position>, nullptr},
      {"joint_velocity", of_axis, observe_axis<&WorldJoints::velocity>, nullptr},
      {"motor_effort", of_axis, observe_axis<&WorldJoints::motor_effort>, nullptr},
      {"target_position", of_axis, observe_axis<&WorldJoints::target_position>,
       command_axis<&WorldJoints::set_target_position>},
      {"target_velocity", of_axis, observe_axis<&WorldJoints::target_velocity>,
       command_axis<&WorldJoints::set_target_velocity>},
      {"target_effort", of_axis, observe_axis<&WorldJoints::target_effort>,
       command_axis<&WorldJoints::set_target_effort>},
      {"max_force", of_axis, observe_axis<&WorldJoints::max_force>, command_axis<&WorldJoints::set_max_force>},
      {"motor_gain", of_axis, observe_axis<&WorldJoints::motor_gain>, command_axis<&WorldJoints::set_motor_gain>},
      {"mass", of_mass, observe_object<&WorldProperties::mass>, command_object<&WorldProperties::set_mass>},
      {"friction", of_friction, observe_object<&WorldProperties::friction>,
       command_object<&WorldProperties::set_friction>},
      {"planar_velocity", of_moving_model, nullptr, command_velocity_of_model},
      {"force", of_body<3>, nullptr,
       [](Simulation& s, ObjectId object, Row& row) {
         s.world().wrenches().apply(object, {take_vector(row), {}});
       }},
      {"torque", of_body<3>, nullptr,
       [](Simulation& s, ObjectId object, Row& row) {
         s.world().wrenches().apply(object, {{}, take_vector(row)});
       }},
  };
}

/// Quantities of sensors of any kind.
std::vector<Kind> settings() {
  return {
      {"noise_scale", of_any_sensor,
       [](Simulation& s, const Place& place, Row& row) { row.put(s.noise_scale(place.object)); },
       [](Simulation& s, ObjectId object, Row& row) { s.set_noise_scale(object, row.take()); }},
  };
}

std::vector<Kind> all() {
  std::vector<Kind> kinds = motions();
  for (const auto& more : {efforts(), settings()}) kinds.insert(kinds.end(), more.begin(), more.end());
  return kinds;
}

}  // namespace

const std::vector<Kind>& world_quantity_kinds() {
  static const std::vector<Kind> kinds = {
      {"time", of_any<0>, [](Simulation& s, const Place&, Row& row) { row.put(s.state_time()); }, nullptr},
      {"gravity", of_any<3>, [](Simulation& s, const Place&, Row& row) { row.put(s.world().properties().gravity()); },
       [](Simulation& s, ObjectId, Row& row) { s.world().properties().set_gravity(take_vector(row)); }},
      {"brightness", of_any<0>, [](Simulation& s, const Place&, Row& row) { row.put(s.brightness()); },
       [](Simulation& s, ObjectId, Row& row) { s.set_brightness(row.take()); }},
  };
  return kinds;
}

const std::vector<Kind>& quantity_kinds() {
  static const std::vector<Kind> kinds = all();
  return kinds;
}

}  // namespace bubblesim
