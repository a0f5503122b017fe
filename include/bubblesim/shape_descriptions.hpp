// SPDX-License-Identifier: BSD-3-Clause
// Shapes of links: what collides, and what rays hit. SI units, angles in radians; each comment names the frame of a
// pose.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "bubblesim/math.hpp"
#include "bubblesim/source.hpp"

namespace bubblesim {

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
struct Capsule {
  double radius = 0;
  double length = 0;  ///< along z, between the centres of its round ends
};
struct Ellipsoid {
  Vector3 radii;  ///< along x, y, z
};
struct Plane {
  Vector3 normal = Vector3::UnitZ();  ///< infinite, through the origin; solid below
};
struct TriangleMesh;  // see triangle_mesh.hpp
struct Mesh {
  std::shared_ptr<const TriangleMesh> triangles;  ///< never null
};
using Geometry = std::variant<Box, Sphere, Cylinder, Capsule, Ellipsoid, Plane, Mesh>;

/// Contact parameters of a shape. src/sim/physics/contacts/surface_pair.hpp combines those of two touching surfaces.
struct Surface {
  double mu = 1;                         ///< Coulomb friction; along fdir1 when mu2 is set
  std::uint16_t collide_bitmask = 0xff;  ///< two shapes collide when they share a bit
  /// For shapes of the same model, if they collide: see ModelDescription::self_collide. Not set: collide_bitmask.
  std::optional<std::uint16_t> own_bitmask{};
  std::optional<double> mu2{};  ///< friction across fdir1; equal to mu when not set
  Vector3 fdir1{};              ///< in the shape's frame; zero: any direction
  double slip1 = 0;             ///< m/s of sliding along fdir1 per N of friction
  double slip2 = 0;             ///< across fdir1
  /// m/s, in the shape's frame: the surface runs about this axis at this speed, like a belt; no file sets it.
  Vector3 belt{};
  double torsion = 0;           ///< m; torque against spinning = torsion * normal force
  double torsion_by_depth = 0;  ///< m^0.5; likewise, times the square root of the depth in m
  double rolling = 0;           ///< m; torque against rolling = rolling * normal force
  /// Contact stiffness in N/m and damping in N s/m; rigid when not set.
  std::optional<double> kp{};
  std::optional<double> kd{};
  /// ODE's equivalents, used when neither kp nor kd is set.
  std::optional<double> soft_erp{};
  std::optional<double> soft_cfm{};
  double restitution = 0;                ///< speed after a bounce divided by the speed before
  double bounce_threshold = 1e5;         ///< m/s; no bounce below this speed
  std::optional<double> max_vel{};       ///< m/s at which overlapping shapes are pushed apart
  std::optional<double> min_depth{};     ///< m, allowed penetration depth
  int max_contacts = 8;                  ///< maximum number of contact points with another shape
  bool collide_without_contact = false;  ///< other shapes pass through this one
};

/// What a mesh collides as. kAuto: its hull if it fills it; otherwise convex parts that fit if it moves, and triangles
/// if it does not.
enum class MeshCollision { kAuto, kHull, kParts, kTriangles };

struct CollisionDescription {
  std::string name;
  Pose pose;  ///< in the link's frame
  Geometry geometry;
  Surface surface;
  Source source;
  MeshCollision mesh_collision = MeshCollision::kAuto;
};

/// Red, green and blue, each from 0 to 1.
struct Color {
  float r = 0;
  float g = 0;
  float b = 0;
};

struct Texture;  // see triangle_mesh.hpp
struct Material {
  Color diffuse{0.7F, 0.7F, 0.7F};
  Color emissive;
  std::shared_ptr<const Texture> texture;  ///< replaces the diffuse colour where the surface has texture coordinates
  double checker_size = 0;                 ///< m, side of a checkerboard square, in the shape's frame; 0: single colour
  Color checker_color;                     ///< of every second square
};

/// A shape that rays hit: those of cameras, lidars and sonars. The collision shapes serve as visuals of a model without
/// visuals.
struct VisualDescription {
  std::string name;
  Pose pose;  ///< in the link's frame
  Geometry geometry;
  Material material;
  bool keeps_mesh_materials = false;  ///< use the materials of the mesh file, if it has any
  bool cast_shadows = true;
  double laser_retro = 0;  ///< intensity of a lidar's return
  Source source;
};

}  // namespace bubblesim
