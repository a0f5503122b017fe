// SPDX-License-Identifier: BSD-3-Clause
#include "run/quantity_kinds.hpp"

#include <algorithm>
#include <initializer_list>
#include <variant>

namespace bubblesim {
namespace {

using Kind = Quantities::Kind;
using Place = Kind::Place;
using Shape = Kind::Shape;
using Sizes = std::vector<std::size_t>;

void put(Row& row, const Vector3& v) {
  for (const double value : {v.x(), v.y(), v.z()}) row.put(value);
}
void put(Row& row, const Quaternion& q) {
  for (const double value : {q.x(), q.y(), q.z(), q.w()}) row.put(value);
}
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
  return std::find(kinds.begin(), kinds.end(), kind) != kinds.end() && !world.description(object).is_static;
}

/// Of an axis of a moving joint.
Shape of_axis(const World& world, ObjectId object) {
  const Object& found = world.tree().at(object);
  if (found.kind != ObjectKind::kJoint || world.joint_axes(object) == 0) return std::nullopt;
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
    world.friction(object);
  } catch (const WrongObject&) {
    return std::nullopt;
  }
  return Sizes{};
}

Shape of_moving_model(const World& world, ObjectId object) {
  if (!moves(world, object, {ObjectKind::kModel}) || world.tree().at(object).parent != kNoObject) return std::nullopt;
  return Sizes{3};
}

template <class Description>
const Description* sensor_of(const World& world, ObjectId object) {
  if (world.tree().at(object).kind != ObjectKind::kSensor) return nullptr;
  return std::get_if<Description>(&world.sensor_description(object).kind);
}

Shape of_any_sensor(const World& world, ObjectId object) {
  if (world.tree().at(object).kind != ObjectKind::kSensor) return std::nullopt;
  return Sizes{};
}

template <class Description, std::size_t... kSizes>
Shape of_sensor(const World& world, ObjectId object) {
  if (sensor_of<Description>(world, object) == nullptr) return std::nullopt;
  return Sizes{kSizes...};
}

Shape of_lidar(const World& world, ObjectId object) {
  const auto* lidar = sensor_of<LidarDescription>(world, object);
  if (lidar == nullptr) return std::nullopt;
  const auto rings = static_cast<std::size_t>(lidar->vertical.samples);
  const auto samples = static_cast<std::size_t>(lidar->horizontal.samples);
  return rings == 1 ? Sizes{samples} : Sizes{rings, samples};
}

Shape of_pixels(const World& world, ObjectId object, bool color) {
  const auto* camera = sensor_of<CameraDescription>(world, object);
  if (camera == nullptr || (color && !camera->color)) return std::nullopt;
  Sizes sizes{static_cast<std::size_t>(camera->height), static_cast<std::size_t>(camera->width)};
  if (color) sizes.push_back(3);
  return sizes;
}
Shape of_image(const World& world, ObjectId object) { return of_pixels(world, object, true); }
Shape of_depth(const World& world, ObjectId object) { return of_pixels(world, object, false); }

/// Calls `use` with the sensor's reading of its kind.
template <class Measured, class Use>
void with_reading(Simulation& simulation, ObjectId sensor, const Use& use) {
  const std::shared_ptr<const Reading> reading = simulation.read(sensor);
  use(std::get<Measured>(reading->measurement));
}

template <class Measured, auto kMember>
void observe_all(Simulation& simulation, const Place& place, Row& row) {
  with_reading<Measured>(simulation, place.object, [&](const Measured& measured) {
    for (const auto value : measured.*kMember) row.put(static_cast<double>(value));
  });
}

template <class Measured, auto kMember>
void observe_member(Simulation& simulation, const Place& place, Row& row) {
  with_reading<Measured>(simulation, place.object, [&](const Measured& measured) {
    if constexpr (std::is_class_v<std::decay_t<decltype(measured.*kMember)>>) {
      put(row, measured.*kMember);
    } else {
      row.put(static_cast<double>(measured.*kMember));
    }
  });
}

template <double (World::*kGet)(ObjectId, int) const>
void observe_axis(Simulation& simulation, const Place& place, Row& row) {
  row.put((simulation.world().*kGet)(place.object, 0));
}

template <void (World::*kSet)(ObjectId, double, int)>
void command_axis(Simulation& simulation, ObjectId joint, Row& row) {
  (simulation.world().*kSet)(joint, row.take(), 0);
}

template <double (World::*kGet)(ObjectId) const>
void observe_object(Simulation& simulation, const Place& place, Row& row) {
  row.put((simulation.world().*kGet)(place.object));
}

template <void (World::*kSet)(ObjectId, double)>
void command_object(Simulation& simulation, ObjectId object, Row& row) {
  (simulation.world().*kSet)(object, row.take());
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
         put(row, pose.position);
         put(row, pose.orientation);
       },
       [](Simulation& s, ObjectId object, Row& row) { s.world().set_pose(object, take_pose(row)); }, true},
      {"position", of_any<3>,
       [](Simulation& s, const Place& place, Row& row) { put(row, pose_of(s.world(), place).position); },
       [](Simulation& s, ObjectId object, Row& row) {
         s.world().set_pose(object, {take_vector(row), s.world().pose(object).orientation});
       },
       true},
      {"orientation", of_any<4>,
       [](Simulation& s, const Place& place, Row& row) { put(row, pose_of(s.world(), place).orientation); }, nullptr,
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
         put(row, twist.linear);
         put(row, twist.angular);
       },
       [](Simulation& s, ObjectId object, Row& row) { s.world().set_velocity(object, take_twist(row)); }, true},
      {"linear_velocity", of_any<3>,
       [](Simulation& s, const Place& place, Row& row) { put(row, velocity_of(s.world(), place).linear); }, nullptr,
       true},
      {"angular_velocity", of_any<3>,
       [](Simulation& s, const Place& place, Row& row) { put(row, velocity_of(s.world(), place).angular); }, nullptr,
       true},
  };
}

/// Quantities of joints, and pushes.
std::vector<Kind> efforts() {
  return {
      {"joint_position", of_axis, observe_axis<&World::joint_position>, nullptr},
      {"joint_velocity", of_axis, observe_axis<&World::joint_velocity>, nullptr},
      {"motor_effort", of_axis, observe_axis<&World::motor_effort>, nullptr},
      {"target_position", of_axis, observe_axis<&World::target_position>, command_axis<&World::set_target_position>},
      {"target_velocity", of_axis, observe_axis<&World::target_velocity>, command_axis<&World::set_target_velocity>},
      {"target_effort", of_axis, observe_axis<&World::target_effort>, command_axis<&World::set_target_effort>},
      {"max_force", of_axis, observe_axis<&World::max_force>, command_axis<&World::set_max_force>},
      {"motor_gain", of_axis, observe_axis<&World::motor_gain>, command_axis<&World::set_motor_gain>},
      {"mass", of_mass, observe_object<&World::mass>, command_object<&World::set_mass>},
      {"friction", of_friction, observe_object<&World::friction>, command_object<&World::set_friction>},
      {"planar_velocity", of_moving_model, nullptr, command_velocity_of_model},
      {"force", of_body<3>, nullptr,
       [](Simulation& s, ObjectId object, Row& row) {
         s.world().apply_wrench(object, {take_vector(row), {}});
       }},
      {"torque", of_body<3>, nullptr,
       [](Simulation& s, ObjectId object, Row& row) {
         s.world().apply_wrench(object, {{}, take_vector(row)});
       }},
  };
}

/// Quantities of sensors.
std::vector<Kind> readings() {
  return {
      {"noise_scale", of_any_sensor,
       [](Simulation& s, const Place& place, Row& row) { row.put(s.noise_scale(place.object)); },
       [](Simulation& s, ObjectId object, Row& row) { s.set_noise_scale(object, row.take()); }},
      {"ranges", of_lidar, observe_all<LidarScan, &LidarScan::ranges>, nullptr},
      {"intensities", of_lidar, observe_all<LidarScan, &LidarScan::intensities>, nullptr},
      {"image", of_image, observe_all<CameraImage, &CameraImage::rgb>, nullptr},
      {"depth", of_depth, observe_all<CameraImage, &CameraImage::depth>, nullptr},
      {"detected", of_sensor<SonarDescription>, observe_member<ProximityReading, &ProximityReading::detected>, nullptr},
      {"distance", of_sensor<SonarDescription>,
       [](Simulation& s, const Place& place, Row& row) {
         const ProximityReading reading = s.read_proximity(place.object);
         row.put(reading.detected
                     ? reading.distance
                     : std::get<SonarDescription>(s.world().sensor_description(place.object).kind).max_range);
       },
       nullptr},
      {"gyroscope", of_sensor<ImuDescription, 3>, observe_member<ImuReading, &ImuReading::angular_velocity>, nullptr},
      {"accelerometer", of_sensor<ImuDescription, 3>, observe_member<ImuReading, &ImuReading::linear_acceleration>,
       nullptr},
      {"geographic_position", of_sensor<NavSatDescription, 3>,
       [](Simulation& s, const Place& place, Row& row) {
         with_reading<NavSatReading>(s, place.object, [&](const NavSatReading& reading) {
           for (const double value : {reading.latitude, reading.longitude, reading.altitude}) row.put(value);
         });
       },
       nullptr},
      {"height", of_sensor<AltimeterDescription>, observe_member<AltimeterReading, &AltimeterReading::height>, nullptr},
      {"magnetic_field", of_sensor<MagnetometerDescription, 3>,
       observe_member<MagnetometerReading, &MagnetometerReading::field>, nullptr},
      {"wrench", of_sensor<ForceTorqueDescription, 6>,
       [](Simulation& s, const Place& place, Row& row) {
         with_reading<ForceTorqueReading>(s, place.object, [&](const ForceTorqueReading& reading) {
           put(row, reading.force);
           put(row, reading.torque);
         });
       },
       nullptr},
      {"contacts", of_sensor<ContactDescription>,
       [](Simulation& s, const Place& place, Row& row) {
         with_reading<ContactReading>(s, place.object, [&](const ContactReading& reading) {
           row.put(static_cast<double>(reading.contacts.size()));
         });
       },
       nullptr},
      {"contact_force", of_sensor<ContactDescription, 3>,
       [](Simulation& s, const Place& place, Row& row) {
         with_reading<ContactReading>(s, place.object, [&](const ContactReading& reading) {
           Vector3 sum;
           for (const Contact& contact : reading.contacts) sum += contact.force;
           put(row, sum);
         });
       },
       nullptr},
  };
}

std::vector<Kind> all() {
  std::vector<Kind> kinds = motions();
  for (const auto& more : {efforts(), readings()}) kinds.insert(kinds.end(), more.begin(), more.end());
  return kinds;
}

}  // namespace

const std::vector<Kind>& world_quantity_kinds() {
  static const std::vector<Kind> kinds = {
      {"time", of_any<0>, [](Simulation& s, const Place&, Row& row) { row.put(s.state_time()); }, nullptr},
      {"gravity", of_any<3>, [](Simulation& s, const Place&, Row& row) { put(row, s.world().gravity()); },
       [](Simulation& s, ObjectId, Row& row) { s.world().set_gravity(take_vector(row)); }},
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
