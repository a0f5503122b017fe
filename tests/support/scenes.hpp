// SPDX-License-Identifier: BSD-3-Clause
// Small scenes built in code, like those of the loader.
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "bubblesim/scene.hpp"
#include "bubblesim/state_archive.hpp"
#include "bubblesim/world.hpp"

namespace bubblesim::test {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// One link without a shape: 1 kg, inertia 1 kg m^2 about each axis.
inline LinkDescription link(const std::string& name, const Vector3& position = {}) {
  LinkDescription link;
  link.name = name;
  link.pose = Pose(position, Quaternion());
  return link;
}

inline CollisionDescription shape(Geometry geometry, double mu = 1, std::uint16_t mask = 0xff) {
  CollisionDescription collision;
  collision.name = "shape";
  collision.geometry = std::move(geometry);
  collision.surface = {mu, mask};
  return collision;
}

inline LinkDescription link_with(Geometry geometry, double mu = 1, std::uint16_t mask = 0xff) {
  LinkDescription described = link("link");
  described.collisions.push_back(shape(std::move(geometry), mu, mask));
  return described;
}

inline ModelDescription model(const std::string& name, LinkDescription described, const Pose& pose = {}) {
  ModelDescription model;
  model.name = name;
  model.pose = pose;
  model.links.push_back(std::move(described));
  return model;
}

inline ModelDescription still(ModelDescription model) {
  model.is_static = true;
  return model;
}

inline Pose at(double x, double y, double z) { return {x, y, z, 0, 0, 0}; }

inline ModelDescription floor(double mu = 1, std::uint16_t mask = 0xff) {
  return still(model("Floor", link_with(Plane{}, mu, mask)));
}

inline AxisDescription axis(const Vector3& direction, MotorMode motor = MotorMode::kNone) {
  AxisDescription axis;
  axis.direction = direction;
  axis.motor = motor;
  return axis;
}

inline JointDescription joint(const std::string& type, std::vector<AxisDescription> axes, const Vector3& anchor = {},
                              const std::string& parent = "base", const std::string& child = "arm") {
  JointDescription joint;
  joint.name = "joint";
  joint.type = type;
  joint.parent = parent;
  joint.child = child;
  joint.pose = Pose(anchor, Quaternion());
  joint.axes = std::move(axes);
  return joint;
}

inline SceneDescription scene(std::vector<ModelDescription> models, const Vector3& gravity = {0, 0, -9.81}) {
  SceneDescription scene;
  scene.name = "test";
  scene.gravity = gravity;
  scene.models = std::move(models);
  return scene;
}

/// A model at `pose` with one sensor that looks along its x axis, after `others`; without gravity.
template <class Kind>
SceneDescription with_sensor(const std::string& name, const Kind& kind, std::vector<ModelDescription> others,
                             const Pose& pose = {}) {
  ModelDescription eye = still(model("Eye", link("link"), pose));
  SensorDescription sensor;
  sensor.name = name;
  sensor.kind = kind;
  eye.links[0].sensors.push_back(sensor);
  others.push_back(eye);
  return scene(std::move(others), Vector3::Zero());
}

/// Two links, `base` and `arm`, and `joint` between them, without gravity and without shapes.
inline SceneDescription jointed(JointDescription joint) {
  ModelDescription robot = model("Robot", link("base"));
  robot.links.push_back(link("arm"));
  robot.joints.push_back(std::move(joint));
  return scene({robot}, Vector3::Zero());
}

inline std::string saved(World& world) {
  std::string state;
  StateArchive archive(state);
  world.transfer(archive);
  return state;
}

inline void restore(const std::string& state, World& world) {
  StateArchive archive{std::string_view(state)};
  world.transfer(archive);
}

/// The rotation of `b` relative to `a`: the angle about `axis`, in -pi..pi.
inline double turn_about(const Vector3& axis, const Pose& a, const Pose& b) {
  const Quaternion relative = a.orientation.conjugate() * b.orientation;
  return 2 * std::atan2(relative.vec().dot(axis), relative.w());
}

}  // namespace bubblesim::test
