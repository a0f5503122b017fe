// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/models/sdf_links.hpp"

#include <cmath>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "bubblesim/nearest_names.hpp"
#include "load/sdf/elements/own_elements.hpp"
#include "load/sdf/models/auto_inertia.hpp"
#include "load/sdf/models/nearest_inertia.hpp"
#include "load/sdf/models/sdf_geometry.hpp"
#include "load/sdf/models/sdf_names_and_axes.hpp"
#include "load/sdf/models/sdf_sensors.hpp"
#include "load/sdf/models/sdf_surface.hpp"
#include "load/sdf/models/sdf_tree.hpp"
#include "load/sdf/models/sdf_visuals.hpp"
#include "meshes/mesh_error.hpp"
#include "scene/describe.hpp"
#include "validation/limits.hpp"
#include "validation/scene_check.hpp"

namespace bubblesim {
namespace {

constexpr double kBallRadius = 0.1;  // m
constexpr double kThin = 1e-3;       // m, of a shape without thickness

MeshCollision read_mesh_collision(const SdfElement& collision, const std::string& path, LoadContext& context) {
  const auto convex = own_text(collision, "bubblesim:convex");
  if (!convex) return MeshCollision::kAuto;
  if (*convex == "hull") return MeshCollision::kHull;
  if (*convex == "parts") return MeshCollision::kParts;
  if (*convex != "none") {
    context.report(collision.source("bubblesim:convex"), path,
                   "<bubblesim:convex> is '" + *convex + "', it must be hull, parts or none" +
                       did_you_mean(*convex, {"hull", "parts", "none"}));
  }
  return MeshCollision::kTriangles;
}

std::optional<CollisionDescription> read_collision(const SdfElement& collision, const Pose& pose,
                                                   const std::string& path, LoadContext& context) {
  CollisionDescription description;
  description.name = collision.name();
  description.source = collision.source();
  description.pose = pose;
  try {
    const auto geometry = read_geometry(collision.child("geometry"), context);
    if (!geometry) return std::nullopt;
    description.geometry = *geometry;
  } catch (const MissingFile& error) {
    context.warn(collision.source("geometry"), path, std::string(error.what()) + "; this collision is ignored");
    return std::nullopt;
  } catch (const MeshError& error) {
    context.report(collision.source("geometry"), path, error.what());
    return std::nullopt;
  }
  description.surface = read_surface(collision, path, context);
  description.mesh_collision = read_mesh_collision(collision, path, context);
  return description;
}

/// A visual whose geometry cannot be read is replaced by the link's collision shapes, in its colour.
void read_visual(const SdfElement& visual, const Pose& pose, const std::string& path, bool is_static,
                 LinkDescription& link, LoadContext& context) {
  VisualDescription description;
  description.name = visual.name();
  description.source = visual.source();
  if (visual.number("transparency") >= 1) return;
  const std::optional<Material> material = read_material(visual, path, context);
  description.material = material.value_or(Material{});
  description.keeps_mesh_materials = !material;
  description.cast_shadows = visual.flag("cast_shadows");
  description.laser_retro = visual.number("laser_retro");
  try {
    const auto geometry = read_geometry(visual.child("geometry"), context);
    if (!geometry) return;
    description.pose = pose;
    description.geometry = *geometry;
    thicken(description.geometry);
    if (const SdfElement plane = visual.child("geometry").child("plane"); plane && !is_static) {
      const Eigen::Vector2d size = plane.child("size").as_vector2();
      description.geometry = Box{{size.x(), size.y(), kThin}};
      description.pose.orientation = description.pose.orientation * turn_from_z(plane.vector("normal"));
    }
    link.visuals.push_back(std::move(description));
    return;
  } catch (const MeshError& error) {
    context.warn(visual.source("geometry"), path,
                 std::string(error.what()) + "; using the link's collision shapes instead");
  }
  for (const CollisionDescription& collision : link.collisions) {
    description.pose = collision.pose;
    description.geometry = collision.geometry;
    link.visuals.push_back(description);
  }
}

/// Gazebo multiplies the velocity by 1 minus this value in each of its steps, which last 1 ms by default: the rate in
/// 1/s that does the same.
double read_decay(const SdfElement& link, const char* which, const std::string& path, LoadContext& context) {
  constexpr double kGazeboStep = 1e-3;  // s
  const SdfElement decay = link.child("velocity_decay");
  const double part = decay.number(which);
  if (part >= 0 && part <= 1) return -std::log1p(-part) / kGazeboStep;
  context.report(decay.source(), path,
                 "<velocity_decay> <" + std::string(which) + "> is " + text(part) + ", it must be from 0 to 1");
  return 0;
}

/// The inertia about the centre of mass, turned from the axes of <inertial> to those of the link.
void read_inertial(const SdfElement& inertial, LinkDescription& link) {
  const Pose pose = inertial.child("pose").as_pose();
  const SdfElement values = inertial.child("inertia");
  const double xy = values.number("ixy");
  const double xz = values.number("ixz");
  const double yz = values.number("iyz");
  Matrix3 inertia;
  inertia << values.number("ixx"), xy, xz, xy, values.number("iyy"), yz, xz, yz, values.number("izz");
  const Matrix3 turn = pose.orientation.toRotationMatrix();
  const Matrix3 turned = turn.isIdentity(0) ? inertia : Matrix3(turn * inertia * turn.transpose());
  link.mass = inertial.number("mass");
  link.centre_of_mass = pose.position;
  link.inertia_diagonal = turned.diagonal();
  link.inertia_products = {turned(0, 1), turned(0, 2), turned(1, 2)};
}

void read_sensors(const SdfElement& link, const Frames& frames, const std::string& path, LinkDescription& description,
                  LoadContext& context) {
  for (const SdfElement& sensor : link.children("sensor")) {
    const Pose pose = frames.pose_of(sensor, link.name(), path + "/" + sensor.name(), context);
    if (is_multicamera(sensor)) {
      for (SensorDescription& read : read_multicamera(sensor, sensor.name(), path, pose, context)) {
        description.sensors.push_back(std::move(read));
      }
    } else if (auto read = read_sensor(sensor, sensor.name(), path, pose, context)) {
      description.sensors.push_back(std::move(*read));
    }
  }
}

}  // namespace

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

// Many robots have a zero inertia, with which a body cannot be rotated, or an impossible one.
void repair_inertia(LinkDescription& link, const std::string& path, LoadContext& context) {
  const Inertia given{link.inertia_diagonal, link.inertia_products};
  if (!within(given.diagonal, 1e9) || !within(given.products, 1e9)) return;  // the check reports it
  if (is_positive_definite(given.diagonal, given.products)) return;
  const bool is_zero = given.diagonal.isZero(0) && given.products.isZero(0);
  const std::optional<Inertia> nearest = nearest_positive_definite(given);
  const std::string is = is_zero ? "the inertia is 0"
                                 : "the inertia is ixx iyy izz " + text(given.diagonal) + ", ixy ixz iyz " +
                                       text(given.products) + ", which is not positive definite";
  if (nearest) {
    link.inertia_diagonal = nearest->diagonal;
    link.inertia_products = nearest->products;
    context.warn(link.source, path,
                 is + ": using the nearest that is, ixx iyy izz " + text(nearest->diagonal) + ", ixy ixz iyz " +
                     text(nearest->products));
    return;
  }
  link.inertia_diagonal = Vector3::Ones() * (0.4 * link.mass * kBallRadius * kBallRadius);
  link.inertia_products = Vector3::Zero();
  context.warn(link.source, path, is + ": using that of a ball with a radius of 0.1 m");
}

LinkDescription read_link(const SdfElement& link, const Frames& frames, const std::string& model_path, bool is_static,
                          LoadContext& context) {
  const std::string path = model_path + "/" + link.name();
  LinkDescription description;
  description.name = link.name();
  description.alias = read_alias(link, path, context);
  description.place = read_place(link);
  description.carrier = link.text("bubblesim:carrier");
  description.pose = frames.pose(link.name());
  description.source = link.source();
  description.gravity_enabled = link.flag("gravity");
  description.wind_enabled = link.flag("enable_wind");
  description.linear_decay = read_decay(link, "linear", path, context);
  description.angular_decay = read_decay(link, "angular", path, context);
  const auto placed = [&](const SdfElement& part) {
    return frames.pose_of(part, link.name(), path + "/" + part.name(), context);
  };
  std::vector<SdfElement> solids;
  for (const SdfElement& collision : link.children("collision")) {
    auto read = read_collision(collision, placed(collision), path + "/" + collision.name(), context);
    if (!read) continue;
    description.collisions.push_back(std::move(*read));
    solids.push_back(collision);
  }
  const SdfElement inertial = link.child("inertial");
  if (!is_static && is_true(inertial.attribute("auto"))) {
    set_auto_inertia(inertial, solids, path, description, context);
  } else {
    read_inertial(inertial, description);
    if (!is_static && description.mass > 0) repair_inertia(description, path, context);
  }
  for (const SdfElement& visual : link.children("visual")) {
    read_visual(visual, placed(visual), path + "/" + visual.name(), is_static, description, context);
  }
  for (const SdfElement& light : link.children("light")) {
    description.lights.push_back(read_light(light, placed(light), path + "/" + light.name(), context));
  }
  read_sensors(link, frames, path, description, context);
  return description;
}

}  // namespace bubblesim
