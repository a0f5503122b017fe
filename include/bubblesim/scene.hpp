// SPDX-License-Identifier: BSD-3-Clause
// What a scene consists of, as loaded: it stays constant while the simulation steps, only the state in World changes.
// SI units, angles in radians, poses in the frame that each comment names.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "bubblesim/math.hpp"

namespace bubblesim {

/// Where in a file something was written, so that errors can point at it.
struct Source {
  std::string file;
  int line = 0;
};

struct Box {
  Vector3 size;  ///< full lengths along x, y, z
};
struct Sphere {
  double radius = 0;
};
struct Cylinder {
  double radius = 0;
  double length = 0;  ///< along z
};
struct Plane {
  Vector3 normal = Vector3::UnitZ;  ///< infinite, through the origin; solid below
};
using Geometry = std::variant<Box, Sphere, Cylinder, Plane>;

struct Surface {
  double mu = 1;                         ///< Coulomb friction; two surfaces in touch use the lower one
  std::uint16_t collide_bitmask = 0xff;  ///< two shapes collide when they share a bit
};

struct CollisionDescription {
  std::string name;
  Pose pose;  ///< in the link's frame
  Geometry geometry;
  Surface surface;
  Source source;
};

/// A cone that reports the nearest thing in it.
struct SonarDescription {
  double min_range = 0;   ///< m; anything nearer is not seen
  double max_range = 1;   ///< m
  double half_angle = 0;  ///< rad, between the axis and the cone's side
};

struct SensorDescription {
  std::string name;
  Pose pose;               ///< in the link's frame; the sensor looks along its x axis
  double update_rate = 0;  ///< Hz; 0 means every pass
  std::variant<SonarDescription> kind;
  Source source;
};

struct LinkDescription {
  std::string name;
  Pose pose;  ///< in the model's frame
  double mass = 1;
  Vector3 centre_of_mass;  ///< in the link's frame
  /// About the centre of mass, along the link's axes: xx, yy, zz, then xy, xz, yz. kg m^2
  Vector3 inertia_diagonal = Vector3::One;
  Vector3 inertia_products;
  std::vector<CollisionDescription> collisions;
  std::vector<SensorDescription> sensors;
  Source source;
};

enum class MotorMode {
  kNone,      ///< free, but for friction and damping
  kVelocity,  ///< holds a target velocity
  kPosition,  ///< goes to a target position and holds it
};

struct AxisDescription {
  Vector3 direction = Vector3::UnitZ;  ///< unit length, in the joint's frame
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  double max_force = std::numeric_limits<double>::infinity();     ///< of the motor; N or N m
  double max_velocity = std::numeric_limits<double>::infinity();  ///< of the motor; m/s or rad/s
  double friction = 0;                                            ///< N or N m against any motion
  double damping = 0;                                             ///< N s/m or N m s/rad
  MotorMode motor = MotorMode::kNone;
};

struct JointDescription {
  std::string name;
  std::string type;    ///< SDFormat's name: revolute, continuous, prismatic, fixed, ball, revolute2
  std::string parent;  ///< link of the same model, or "world"
  std::string child;
  Pose pose;  ///< in the model's frame
  std::vector<AxisDescription> axes;
  Source source;
};

struct ModelDescription {
  std::string name;
  Pose pose;  ///< in the world
  bool is_static = false;
  bool self_collide = false;
  std::string canonical_link;
  std::vector<LinkDescription> links;
  std::vector<JointDescription> joints;
  std::filesystem::path child_script;  ///< empty when it has none
  Source source;
};

struct SceneDescription {
  std::string name;
  std::filesystem::path file;
  Vector3 gravity{0, 0, -9.81};  ///< m/s^2
  double time_step = 0.05;       ///< s, of one simulation pass
  double physics_step = 0.005;   ///< s, of one physics substep; divides time_step
  std::vector<ModelDescription> models;
  Source source;
};

}  // namespace bubblesim
