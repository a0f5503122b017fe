// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/sdf_links.hpp"

#include <cmath>
#include <map>
#include <optional>
#include <sdf/Collision.hh>
#include <sdf/Plane.hh>
#include <sdf/Visual.hh>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "bubblesim/nearest_names.hpp"
#include "check/checks.hpp"
#include "check/scene_check.hpp"
#include "load/sdf/nearest_inertia.hpp"
#include "load/sdf/sdf_geometry.hpp"
#include "load/sdf/sdf_left_out.hpp"
#include "load/sdf/sdf_names_and_axes.hpp"
#include "load/sdf/sdf_plugins.hpp"
#include "load/sdf/sdf_sensors.hpp"
#include "load/sdf/sdf_source.hpp"
#include "load/sdf/sdf_surface.hpp"
#include "load/sdf/sdf_visuals.hpp"
#include "load/sdf_extensions.hpp"
#include "meshes/mesh_error.hpp"
#include "scene/describe.hpp"

namespace bubblesim {
namespace {

constexpr double kBallRadius = 0.1;  // m
constexpr double kThin = 1e-3;       // m, of a shape without thickness

Quaternion turn_from_z(const Vector3& direction) {
  Quaternion turn;
  turn.From2Axes(Vector3::UnitZ, direction);
  return turn;
}

/// SDFormat drops shapes with the name of another shape of their link; Gazebo keeps them. Numbers are appended to their
/// names.
template <class Shape>
std::vector<Shape> namesakes(const sdf::ElementPtr& link, const char* kind, const std::string& link_path,
                             LoadContext& reading) {
  std::vector<Shape> found;
  std::map<std::string, int> known;
  if (!link->HasElement(kind)) return found;
  for (auto element = link->GetElement(kind); element != nullptr; element = element->GetNextElement(kind)) {
    const auto name = element->Get<std::string>("name");
    const int number = ++known[name];
    if (number == 1) continue;
    Shape shape;
    shape.Load(element);  // errors were reported when the file was read
    shape.SetName(name + "_" + std::to_string(number));
    reading.warn(source_of(element), link_path + "/" + shape.Name(),
                 "renamed: the name '" + name + "' is used already");
    found.push_back(std::move(shape));
  }
  return found;
}

MeshCollision read_mesh_collision(const sdf::ElementPtr& collision, const std::string& path, LoadContext& reading) {
  const auto convex = own_text(collision, "bubblesim:convex");
  if (!convex) return MeshCollision::kAuto;
  if (*convex == "hull") return MeshCollision::kHull;
  if (*convex == "parts") return MeshCollision::kParts;
  if (*convex != "none") {
    reading.report(source_of(collision, "bubblesim:convex"), path,
                   "<bubblesim:convex> is '" + *convex + "', it must be hull, parts or none" +
                       did_you_mean(*convex, {"hull", "parts", "none"}));
  }
  return MeshCollision::kTriangles;
}

std::optional<CollisionDescription> read_collision(const sdf::Collision& collision, const Pose& pose,
                                                   const std::string& link_path, LoadContext& reading) {
  CollisionDescription description;
  description.name = collision.Name();
  description.source = source_of(collision.Element());
  const std::string path = link_path + "/" + collision.Name();
  description.pose = pose;
  try {
    const auto geometry = read_geometry(*collision.Geom(), reading);
    if (!geometry) return std::nullopt;
    description.geometry = *geometry;
  } catch (const MissingFile& error) {
    reading.warn(source_of(collision.Element(), "geometry"), path,
                 std::string(error.what()) + "; this collision is ignored");
    return std::nullopt;
  } catch (const MeshError& error) {
    reading.report(source_of(collision.Element(), "geometry"), path, error.what());
    return std::nullopt;
  }
  description.surface = read_surface(collision.Element(), path, reading);
  description.mesh_collision = read_mesh_collision(collision.Element(), path, reading);
  return description;
}

/// Visuals may be flat.
void thicken(Geometry& geometry) {
  const auto thick = [](double& length) {
    if (length == 0) length = kThin;
  };
  if (auto* box = std::get_if<Box>(&geometry)) {
    for (std::size_t axis = 0; axis < 3; ++axis) thick(box->size[axis]);
  } else if (auto* sphere = std::get_if<Sphere>(&geometry)) {
    thick(sphere->radius);
  } else if (auto* cylinder = std::get_if<Cylinder>(&geometry)) {
    thick(cylinder->radius);
    thick(cylinder->length);
  }
}

/// A visual whose geometry cannot be read is replaced by the link's collision shapes, in its colour.
void read_visual(const sdf::Visual& visual, const Pose& pose, const std::string& link_path, bool is_static,
                 LinkDescription& link, LoadContext& reading) {
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
    const auto geometry = read_geometry(*visual.Geom(), reading);
    if (!geometry) return;
    description.pose = pose;
    description.geometry = *geometry;
    thicken(description.geometry);
    if (const auto* plane = visual.Geom()->PlaneShape(); plane != nullptr && !is_static) {
      description.geometry = Box{{plane->Size().X(), plane->Size().Y(), kThin}};
      description.pose.Rot() = description.pose.Rot() * turn_from_z(plane->Normal());
    }
    link.visuals.push_back(std::move(description));
    return;
  } catch (const MeshError& error) {
    reading.warn(source_of(visual.Element(), "geometry"), path,
                 std::string(error.what()) + "; using the link's collision shapes instead");
  }
  for (const CollisionDescription& collision : link.collisions) {
    description.pose = collision.pose;
    description.geometry = collision.geometry;
    link.visuals.push_back(description);
  }
}

/// Many robots have a zero inertia, with which a body cannot be rotated, or an impossible one.
void repair_inertia(LinkDescription& link, const std::string& path, LoadContext& reading) {
  const Inertia given{link.inertia_diagonal, link.inertia_products};
  if (!within(given.diagonal, 1e9) || !within(given.products, 1e9)) return;  // the check reports it
  if (is_positive_definite(given.diagonal, given.products)) return;
  // Not by ==, which has a tolerance.
  const bool is_zero = given.diagonal.Length() == 0 && given.products.Length() == 0;
  const std::optional<Inertia> nearest = nearest_positive_definite(given);
  const std::string is = is_zero ? "the inertia is 0"
                                 : "the inertia is ixx iyy izz " + text(given.diagonal) + ", ixy ixz iyz " +
                                       text(given.products) + ", which is not positive definite";
  if (nearest) {
    link.inertia_diagonal = nearest->diagonal;
    link.inertia_products = nearest->products;
    reading.warn(link.source, path,
                 is + ": using the nearest that is, ixx iyy izz " + text(nearest->diagonal) + ", ixy ixz iyz " +
                     text(nearest->products));
    return;
  }
  link.inertia_diagonal = Vector3::One * (0.4 * link.mass * kBallRadius * kBallRadius);
  link.inertia_products = Vector3::Zero;
  reading.warn(link.source, path, is + ": using that of a ball with a radius of 0.1 m");
}

/// Gazebo multiplies the velocity by 1 minus this value in each of its steps, which last 1 ms by default: the rate in
/// 1/s that does the same.
double read_decay(const sdf::ElementPtr& link, const char* which, const std::string& path, LoadContext& reading) {
  constexpr double kGazeboStep = 1e-3;  // s
  if (!link->HasElement("velocity_decay")) return 0;
  const sdf::ElementPtr decay = link->GetElement("velocity_decay");
  const double part = decay->Get<double>(which, 0.0).first;
  if (part >= 0 && part <= 1) return -std::log1p(-part) / kGazeboStep;
  reading.report(source_of(decay), path,
                 "<velocity_decay> <" + std::string(which) + "> is " + text(part) + ", it must be from 0 to 1");
  return 0;
}

}  // namespace

LinkDescription read_link(const sdf::Link& link, const std::string& model_path, bool is_static, LoadContext& reading) {
  const std::string path = model_path + "/" + link.Name();
  LinkDescription description;
  description.name = link.Name();
  description.alias = read_alias(link.Element(), path, reading);
  description.pose = reading.resolved(link, path);
  description.source = source_of(link.Element());
  report_left_out(link.Element(), path, reading);
  description.gravity_enabled = link.Element()->Get<bool>("gravity", true).first;
  description.wind_enabled = link.EnableWind();
  description.linear_decay = read_decay(link.Element(), "linear", path, reading);
  description.angular_decay = read_decay(link.Element(), "angular", path, reading);
  const auto& inertial = link.Inertial();
  const ignition::math::Matrix3d inertia = inertial.Moi();
  description.mass = inertial.MassMatrix().Mass();
  description.centre_of_mass = inertial.Pose().Pos();
  description.inertia_diagonal = {inertia(0, 0), inertia(1, 1), inertia(2, 2)};
  description.inertia_products = {inertia(0, 1), inertia(0, 2), inertia(1, 2)};
  if (!is_static && description.mass > 0) repair_inertia(description, path, reading);
  for (std::uint64_t i = 0; i < link.CollisionCount(); ++i) {
    const sdf::Collision& collision = *link.CollisionByIndex(i);
    const Pose pose = reading.resolved(collision, path + "/" + collision.Name());
    if (auto read = read_collision(collision, pose, path, reading)) description.collisions.push_back(std::move(*read));
  }
  for (const auto& collision : namesakes<sdf::Collision>(link.Element(), "collision", path, reading)) {
    auto read = read_collision(collision, collision.RawPose(), path, reading);
    if (read) description.collisions.push_back(std::move(*read));
  }
  for (std::uint64_t i = 0; i < link.VisualCount(); ++i) {
    const sdf::Visual& visual = *link.VisualByIndex(i);
    read_visual(visual, reading.resolved(visual, path + "/" + visual.Name()), path, is_static, description, reading);
  }
  for (const auto& visual : namesakes<sdf::Visual>(link.Element(), "visual", path, reading)) {
    read_visual(visual, visual.RawPose(), path, is_static, description, reading);
  }
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
