// SPDX-License-Identifier: BSD-3-Clause
// What a scene consists of, as loaded: it stays constant while the simulation steps, only the state in World changes.
// SI units, angles in radians, poses in the frame that each comment names.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
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
struct Capsule {
  double radius = 0;
  double length = 0;  ///< along z, between the centres of its round ends
};
struct Ellipsoid {
  Vector3 radii;  ///< along x, y, z
};
struct Plane {
  Vector3 normal = Vector3::UnitZ;  ///< infinite, through the origin; solid below
};
struct TriangleMesh;  // see triangle_mesh.hpp
struct Mesh {
  std::shared_ptr<const TriangleMesh> triangles;  ///< never null
};
using Geometry = std::variant<Box, Sphere, Cylinder, Capsule, Ellipsoid, Plane, Mesh>;

/// How a shape touches another. What the two surfaces in touch make together is in src/sim/surface_pair.hpp.
struct Surface {
  double mu = 1;                         ///< Coulomb friction; along fdir1 when mu2 is another
  std::uint16_t collide_bitmask = 0xff;  ///< two shapes collide when they share a bit
  std::optional<double> mu2{};           ///< friction across fdir1; as mu when nothing is said
  Vector3 fdir1{};                       ///< in the shape's frame; zero when any direction will do
  double slip1 = 0;                      ///< m/s that the surfaces slide along fdir1 for each N of friction
  double slip2 = 0;                      ///< across fdir1
  double torsion = 0;                    ///< m; times the normal force, the torque that brakes a spin on the spot
  /// Stiffness in N/m and damping in N s/m of the contact; rigid when nothing is said.
  std::optional<double> kp{};
  std::optional<double> kd{};
  /// ODE's own words for the same, taken when there is neither kp nor kd.
  std::optional<double> soft_erp{};
  std::optional<double> soft_cfm{};
  double restitution = 0;                ///< speed after a bounce by that before
  double bounce_threshold = 1e5;         ///< m/s; what comes slower does not bounce
  std::optional<double> max_vel{};       ///< m/s at which overlapping shapes are pushed apart
  std::optional<double> min_depth{};     ///< m that shapes may sink into one another
  int max_contacts = 8;                  ///< points in which it touches another shape
  bool collide_without_contact = false;  ///< others pass through it
};

struct CollisionDescription {
  std::string name;
  Pose pose;  ///< in the link's frame
  Geometry geometry;
  Surface surface;
  Source source;
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
  std::shared_ptr<const Texture> texture;  ///< in place of the diffuse colour, where a surface has coordinates for it
  double checker_size = 0;  ///< m, side of a checkerboard's fields in the shape's frame; 0 for a single colour
  Color checker_color;      ///< of every other field
};

/// What rays see: cameras, lidars and sonars alike. A model without any shows its collision shapes instead.
struct VisualDescription {
  std::string name;
  Pose pose;  ///< in the link's frame
  Geometry geometry;
  Material material;
  bool keeps_mesh_materials = false;  ///< those that the mesh brings count, where it brings any
  bool cast_shadows = true;
  double laser_retro = 0;  ///< intensity of a lidar's return
  Source source;
};

enum class LightKind {
  kDirectional,  ///< from infinitely far away
  kPoint,        ///< to all sides
  kSpot,         ///< in a cone
};

/// Position and direction are in the world, or in the frame of the link that carries it.
struct Light {
  Vector3 direction{-0.5, 0.1, -0.9};  ///< in which it shines; of no meaning to a point light
  Color diffuse{0.8F, 0.8F, 0.8F};
  bool cast_shadows = true;
  LightKind kind = LightKind::kDirectional;
  // Of point lights and spotlights:
  Vector3 position;
  double range = 10;                 ///< m, beyond which it does not shine
  double constant_attenuation = 1;   ///< it shines with 1 / (constant + linear d + quadratic d^2) at a distance of d
  double linear_attenuation = 0;     ///< 1/m
  double quadratic_attenuation = 0;  ///< 1/m^2
  // Of spotlights:
  double inner_angle = 0;  ///< rad across, within which it is at its brightest
  double outer_angle = 0;  ///< rad across, beyond which it does not shine
  double falloff = 1;      ///< exponent of the brightness between the two
};

/// Where on Earth the scene's origin lies, on the ellipsoid WGS84.
struct GeographicOrigin {
  double latitude = 0;   ///< degrees, to the north
  double longitude = 0;  ///< degrees, to the east
  double elevation = 0;  ///< m above the ellipsoid
  double heading = 0;    ///< rad, from the east to the scene's x axis, counter-clockwise seen from above
};

/// What surrounds the models: light and background as cameras see them, and the place on Earth.
struct Environment {
  Color ambient{0.4F, 0.4F, 0.4F};
  Color background{0.7F, 0.7F, 0.7F};
  bool sky = false;  ///< a gradient from the horizon up in place of the background
  bool shadows = true;
  std::vector<Light> lights{Light{}};
  GeographicOrigin origin;
  Vector3 magnetic_field{5.5645e-6, 22.8758e-6, -42.3884e-6};  ///< T, world axes; SDFormat's default
};

/// Gaussian noise of a measured value: value + N(mean, stddev) + bias, rounded to multiples of `precision`. The bias is
/// drawn once, from N(bias_mean, bias_stddev).
struct NoiseDescription {
  double mean = 0;
  double stddev = 0;
  double bias_mean = 0;
  double bias_stddev = 0;
  double precision = 0;  ///< 0: not rounded
};

enum class ProximityVolume {
  kRay,       ///< a single ray
  kCone,      ///< round
  kPyramid,   ///< square, as wide and high as the cone
  kDisc,      ///< a flat fan to the left and right
  kCylinder,  ///< parallel rays, all of the radius that the cone has at its end
};

/// A volume in which the nearest thing is reported.
struct SonarDescription {
  double min_range = 0;   ///< m, where the rays begin: anything nearer is not seen
  double max_range = 1;   ///< m
  double half_angle = 0;  ///< rad, between the axis and the volume's side
  ProximityVolume volume = ProximityVolume::kCone;
};

/// Angles of a scan: `samples` of them evenly from `min` to `max`, both included; one alone lies at `min`.
struct ScanAngles {
  int samples = 1;
  double min = 0;  ///< rad
  double max = 0;  ///< rad

  double at(int i) const { return samples > 1 ? min + (max - min) * i / (samples - 1) : min; }
};

struct LidarDescription {
  ScanAngles horizontal;  ///< about z, to the left
  ScanAngles vertical;    ///< upwards
  double min_range = 0;   ///< m, where the rays begin: anything nearer is not seen
  double max_range = 1;   ///< m
  double resolution = 0;  ///< m; ranges are rounded to multiples of it, 0: not rounded
  NoiseDescription noise;
  std::string signal;  ///< string signal in which child scripts find the points; empty: none
};

/// A pinhole camera that looks along x, with y to the left and z up.
struct CameraDescription {
  int width = 320;                ///< pixels
  int height = 240;               ///< pixels
  double horizontal_fov = 1.047;  ///< rad
  double near = 0.1;              ///< m along the axis
  double far = 100;               ///< m along the axis
  bool color = true;              ///< false for a camera that measures depth only
  bool antialias = false;         ///< four rays a pixel
  NoiseDescription noise;         ///< of each colour value, from 0 to 1, or of the depth in m when there is no colour
};

/// An inertial measurement unit; noise along x, y, z.
struct ImuDescription {
  std::array<NoiseDescription, 3> angular_velocity_noise;     ///< rad/s
  std::array<NoiseDescription, 3> linear_acceleration_noise;  ///< m/s^2
};

/// One element in a <plugin>: its name and text, or what stands in it.
struct PluginParameter {
  std::string name;
  std::string text;
  std::vector<PluginParameter> children;
  Source source;
};

/// What a file asks other simulators to load; the core hands it on as it stands.
struct PluginDescription {
  std::string name;
  std::string filename;  ///< of the library, such as libgazebo_ros_diff_drive.so
  std::vector<PluginParameter> parameters;
  Source source;
};

/// A receiver of satellite navigation.
struct NavSatDescription {
  NoiseDescription horizontal_position_noise;  ///< m, to the east and to the north
  NoiseDescription vertical_position_noise;    ///< m
  NoiseDescription horizontal_velocity_noise;  ///< m/s, to the east and to the north
  NoiseDescription vertical_velocity_noise;    ///< m/s
};

/// Tells how high it is above where it started.
struct AltimeterDescription {
  NoiseDescription position_noise;  ///< m
  NoiseDescription velocity_noise;  ///< m/s
};

/// Feels the magnetic field of the Earth; noise along x, y, z.
struct MagnetometerDescription {
  std::array<NoiseDescription, 3> field_noise;  ///< T
};

/// Feels what its link touches.
struct ContactDescription {
  std::vector<std::string> collisions;  ///< of the link; empty for all of them
};

inline bool watches(const ContactDescription& sensor, const std::string& collision) {
  return sensor.collisions.empty() ||
         std::find(sensor.collisions.begin(), sensor.collisions.end(), collision) != sensor.collisions.end();
}

/// Feels what a joint transmits.
struct ForceTorqueDescription {
  enum class Frame { kChild, kParent, kSensor };

  Frame frame = Frame::kChild;  ///< whose axes the readings are in
  bool of_child = true;         ///< what the child does to the parent; else what the parent does to the child
  std::array<NoiseDescription, 3> force_noise;   ///< N
  std::array<NoiseDescription, 3> torque_noise;  ///< N m
};

/// How gz-sim publishes a sensor.
struct GzTopic {
  std::string topic;       ///< its <topic>; empty: named after the sensor's place in the world
  std::string info_topic;  ///< of a camera's <camera_info_topic>; empty: beside the topic
  std::string frame;       ///< its <gz_frame_id>, or a camera's <optical_frame_id>; empty: MODEL/LINK/SENSOR
};

struct SensorDescription {
  std::string name;
  std::string type;        ///< SDFormat's name, such as gpu_lidar
  Pose pose;               ///< in the frame of its link or joint; the sensor looks along its x axis
  double update_rate = 0;  ///< Hz; 0 means every step
  std::variant<SonarDescription, LidarDescription, CameraDescription, ImuDescription, NavSatDescription,
               AltimeterDescription, MagnetometerDescription, ContactDescription, ForceTorqueDescription>
      kind;
  std::vector<PluginDescription> plugins;
  std::string topic;  ///< on which it is published; empty: its plugins may publish it
  std::string frame;  ///< of what is published, its link unless given
  GzTopic gz;
  Source source;
};

struct LinkDescription {
  std::string name;
  bool gravity_enabled = true;  ///< gravity pulls it
  Pose pose;                    ///< in the model's frame
  std::optional<Pose> start{};  ///< the same when the simulation begins, where joints are not at their zero then
  double mass = 1;
  Vector3 centre_of_mass;  ///< in the link's frame
  /// About the centre of mass, along the link's axes: xx, yy, zz, then xy, xz, yz. kg m^2
  Vector3 inertia_diagonal = Vector3::One;
  Vector3 inertia_products;
  std::vector<CollisionDescription> collisions;
  std::vector<VisualDescription> visuals;
  std::vector<SensorDescription> sensors;
  std::vector<Light> lights;  ///< positions and directions in the link's frame
  Source source;
};

enum class MotorMode {
  kNone,      ///< free, but for friction and damping
  kVelocity,  ///< holds a target velocity
  kPosition,  ///< goes to a target position and holds it
};

/// An axis that follows another: position = multiplier * (leader's position - reference) + offset.
struct MimicDescription {
  std::string joint;  ///< of the same model
  int axis = 0;       ///< of the leader
  double multiplier = 1;
  double offset = 0;     ///< rad or m
  double reference = 0;  ///< rad or m
};

struct AxisDescription {
  Vector3 direction = Vector3::UnitZ;  ///< unit length, in the joint's frame
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  double max_force = std::numeric_limits<double>::infinity();     ///< of the motor; N or N m
  double max_velocity = std::numeric_limits<double>::infinity();  ///< of the motor; m/s or rad/s
  double friction = 0;                                            ///< N or N m against any motion
  double damping = 0;                                             ///< N s/m or N m s/rad
  double spring_stiffness = 0;                                    ///< N/m or N m/rad
  double spring_reference = 0;                                    ///< m or rad, where the spring is at rest
  MotorMode motor = MotorMode::kNone;
  std::optional<MimicDescription> mimic;  ///< in place of the motor's targets
};

struct JointDescription {
  std::string name;
  std::string type;    ///< SDFormat's name: see joint_kinds() in src/sim/joints
  std::string parent;  ///< link of the same model, or "world"
  std::string child;
  Pose pose;  ///< in the model's frame
  std::vector<AxisDescription> axes;
  std::vector<SensorDescription> sensors;  ///< of force and torque
  double screw_lead = 1;                   ///< m that a screw's child moves along the axis in a turn about it
  double gearbox_ratio = 1;  ///< the child of a gearbox turns by -ratio times the parent's angle, both in the reference
  std::string gearbox_reference;  ///< link that both are held in by hinges, or "world"
  Source source;
};

/// A model inside another. Its links and joints are among those of the outermost model, named `inner::link`.
struct NestedModelDescription {
  std::string name;  ///< from the outermost model on: `inner`, `inner::deeper`; outer ones come before inner ones
  Pose pose;         ///< in the outermost model's frame
  std::string canonical_link;
  std::filesystem::path child_script;  ///< empty when it has none
  std::vector<PluginDescription> plugins;
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
  std::vector<NestedModelDescription> nested;
  std::filesystem::path child_script;  ///< empty when it has none
  std::vector<PluginDescription> plugins;
  Source source;
};

/// What happens to a model whose motion leaves the finite world.
enum class OnDivergence {
  kPause,   ///< the simulation pauses
  kReset,   ///< the world is put back to its start
  kRemove,  ///< the model is removed
};

struct SceneDescription {
  std::string name;
  std::string world_name;  ///< of the <world>; that of the scene when the file has none
  std::filesystem::path file;
  Vector3 gravity{0, 0, -9.81};  ///< m/s^2
  double time_step = 0.05;       ///< s, of one simulation step
  double substep = 0.005;        ///< s, of one physics substep; divides time_step
  OnDivergence on_divergence = OnDivergence::kPause;
  Environment environment;
  std::vector<ModelDescription> models;
  std::vector<PluginDescription> plugins;
  bool is_model_file = false;  ///< the file holds a model and no world: it was put on a ground plane
  Source source;
};

}  // namespace bubblesim
