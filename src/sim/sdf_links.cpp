// SPDX-License-Identifier: BSD-3-Clause
#include "sdf_links.hpp"

#include <optional>
#include <sdf/Collision.hh>
#include <sdf/Plane.hh>
#include <sdf/Visual.hh>
#include <utility>

#include "meshes/mesh_error.hpp"
#include "sdf_geometry.hpp"
#include "sdf_plugins.hpp"
#include "sdf_sensors.hpp"
#include "sdf_source.hpp"
#include "sdf_surface.hpp"
#include "sdf_visuals.hpp"

namespace bubblesim {
namespace {

constexpr double kBallRadius = 0.1;  // m
constexpr double kThin = 1e-3;       // m, of a plane that can move and thus ends somewhere

Quaternion turn_from_z(const Vector3& direction) {
  Quaternion turn;
  turn.From2Axes(Vector3::UnitZ, direction);
  return turn;
}

std::optional<CollisionDescription> read_collision(const sdf::Collision& collision, const std::string& link_path,
                                                   SceneReading& reading) {
  CollisionDescription description;
  description.name = collision.Name();
  description.source = source_of(collision.Element());
  const std::string path = link_path + "/" + collision.Name();
  description.pose = reading.resolved(collision, path);
  try {
    const auto geometry = read_geometry(*collision.Geom(), reading.folder());
    if (!geometry) return std::nullopt;
    description.geometry = *geometry;
  } catch (const MeshError& error) {
    reading.report(source_of(collision.Element(), "geometry"), path, error.what());
    return std::nullopt;
  }
  description.surface = read_surface(collision.Element(), path, reading);
  return description;
}

/// A visual whose shape cannot be had is replaced by the link's collision shapes, in its colour.
void read_visual(const sdf::Visual& visual, const std::string& link_path, bool is_static, LinkDescription& link,
                 SceneReading& reading) {
  VisualDescription description;
  description.name = visual.Name();
  description.source = source_of(visual.Element());
  if (visual.Transparency() >= 1) return;
  const std::optional<Material> material = read_material(visual, reading);
  description.material = material.value_or(Material{});
  description.keeps_mesh_materials = !material;
  description.cast_shadows = visual.CastShadows();
  description.laser_retro = visual.LaserRetro();
  const std::string path = link_path + "/" + visual.Name();
  try {
    const auto geometry = read_geometry(*visual.Geom(), reading.folder());
    if (!geometry) return;
    description.pose = reading.resolved(visual, path);
    description.geometry = *geometry;
    if (const auto* plane = visual.Geom()->PlaneShape(); plane != nullptr && !is_static) {
      description.geometry = Box{{plane->Size().X(), plane->Size().Y(), kThin}};
      description.pose.Rot() = description.pose.Rot() * turn_from_z(plane->Normal());
    }
    link.visuals.push_back(std::move(description));
    return;
  } catch (const MeshError& error) {
    SceneReading::warn(source_of(visual.Element(), "geometry"), path,
                       std::string(error.what()) + "; the link shows its collision shapes instead");
  }
  for (const CollisionDescription& collision : link.collisions) {
    description.pose = collision.pose;
    description.geometry = collision.geometry;
    link.visuals.push_back(description);
  }
}

/// Many robots leave it at zero, with which nothing can turn.
void give_inertia(LinkDescription& link, const std::string& path) {
  link.inertia_diagonal = Vector3::One * (0.4 * link.mass * kBallRadius * kBallRadius);
  SceneReading::warn(link.source, path, "the inertia is 0: that of a ball with a radius of 0.1 m is taken instead");
}

}  // namespace

LinkDescription read_link(const sdf::Link& link, const std::string& model_path, bool is_static, SceneReading& reading) {
  const std::string path = model_path + "/" + link.Name();
  LinkDescription description;
  description.name = link.Name();
  description.pose = reading.resolved(link, path);
  description.source = source_of(link.Element());
  description.has_weight = link.Element()->Get<bool>("gravity", true).first;
  const auto& inertial = link.Inertial();
  const ignition::math::Matrix3d inertia = inertial.Moi();
  description.mass = inertial.MassMatrix().Mass();
  description.centre_of_mass = inertial.Pose().Pos();
  description.inertia_diagonal = {inertia(0, 0), inertia(1, 1), inertia(2, 2)};
  description.inertia_products = {inertia(0, 1), inertia(0, 2), inertia(1, 2)};
  // Not by ==, which takes what is small for zero.
  const bool is_zero = description.inertia_diagonal.Length() == 0 && description.inertia_products.Length() == 0;
  if (!is_static && description.mass > 0 && is_zero) give_inertia(description, path);
  for (std::uint64_t i = 0; i < link.CollisionCount(); ++i) {
    const sdf::Collision& collision = *link.CollisionByIndex(i);
    if (auto read = read_collision(collision, path, reading)) description.collisions.push_back(std::move(*read));
  }
  for (std::uint64_t i = 0; i < link.VisualCount(); ++i)
    read_visual(*link.VisualByIndex(i), path, is_static, description, reading);
  for (std::uint64_t i = 0; i < link.LightCount(); ++i) {
    const sdf::Light& light = *link.LightByIndex(i);
    description.lights.push_back(read_light(light, reading.resolved(light, path + "/" + light.Name())));
  }
  for (std::uint64_t i = 0; i < link.SensorCount(); ++i) {
    const sdf::Sensor& sensor = *link.SensorByIndex(i);
    const Pose pose = reading.resolved(sensor, path + "/" + sensor.Name());
    if (sensor.Type() == sdf::SensorType::MULTICAMERA) {
      for (SensorDescription& read : read_multicamera(sensor, path, pose, reading)) {
        description.sensors.push_back(std::move(read));
      }
    } else if (auto read = read_sensor(sensor, path, pose, reading)) {
      description.sensors.push_back(std::move(*read));
    }
  }
  return description;
}

}  // namespace bubblesim
