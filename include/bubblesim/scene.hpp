// SPDX-License-Identifier: BSD-3-Clause
// Description of a scene, as loaded. It stays constant while the simulation steps; only the state in World changes. SI
// units, angles in radians; each comment names the frame of a pose.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "bubblesim/math.hpp"
#include "bubblesim/random_quantity.hpp"
#include "bubblesim/sensor_kinds.hpp"
#include "bubblesim/shape_descriptions.hpp"
#include "bubblesim/source.hpp"
#include "bubblesim/transmission.hpp"

namespace bubblesim {

enum class LightKind {
  kDirectional,  ///< from infinitely far away
  kPoint,        ///< in all directions
  kSpot,         ///< in a cone
};

/// Position and direction are in the world frame, or in the frame of the link that has the light.
struct Light {
  Vector3 direction{-0.5, 0.1, -0.9};  ///< of the light; ignored for point lights
  Color diffuse{0.8F, 0.8F, 0.8F};
  bool cast_shadows = true;
  LightKind kind = LightKind::kDirectional;
  // For point lights and spotlights:
  Vector3 position;
  double range = 10;                 ///< m, no light beyond this distance
  double constant_attenuation = 1;   ///< intensity is 1 / (constant + linear d + quadratic d^2) at the distance d
  double linear_attenuation = 0;     ///< 1/m
  double quadratic_attenuation = 0;  ///< 1/m^2
  // For spotlights:
  double inner_angle = 0;  ///< rad, full angle of the cone of full brightness
  double outer_angle = 0;  ///< rad, full angle of the light cone
  double falloff = 1;      ///< exponent of the brightness between the two
};

/// Geographic coordinates of the scene's origin on the WGS84 ellipsoid.
struct GeographicOrigin {
  double latitude = 0;   ///< degrees north
  double longitude = 0;  ///< degrees east
  double elevation = 0;  ///< m above the ellipsoid
  double heading = 0;    ///< rad, from east to the scene's x axis, counter-clockwise seen from above
};

/// Surroundings of the models: light and background for cameras, and the geographic origin.
struct Environment {
  Color ambient{0.4F, 0.4F, 0.4F};
  Color background{0.7F, 0.7F, 0.7F};
  bool sky = false;  ///< a gradient above the horizon replaces the background
  bool shadows = true;
  std::vector<Light> lights{Light{}};
  GeographicOrigin origin;
  Vector3 magnetic_field{5.5645e-6, 22.8758e-6, -42.3884e-6};  ///< T, world axes; SDFormat's default
  Vector3 wind;                                                ///< m/s, world axes; mean velocity
};

/// An element of a <plugin>: its name and text, or its child elements.
struct PluginParameter {
  std::string name;
  std::string text;
  std::vector<PluginParameter> children;
  Source source;
};

/// A <plugin> of the file; the core passes it on unchanged.
struct PluginDescription {
  std::string name;
  std::string filename;  ///< of the library, such as libgazebo_ros_diff_drive.so
  std::vector<PluginParameter> parameters;
  Source source;
};

/// Topics and frame under which gz-sim publishes a sensor.
struct GzTopic {
  std::string topic;       ///< its <topic>; empty: named after the sensor's path in the world
  std::string info_topic;  ///< of a camera's <camera_info_topic>; empty: next to the topic
  std::string frame;       ///< its <gz_frame_id>, or a camera's <optical_frame_id>; empty: MODEL/LINK/SENSOR
};

/// A parameter that a foreign scene gives to the script of an object, as text.
struct ScriptParameter {
  std::string name;
  std::string unit;
  std::string value;
};

/// The place of an object in the tree that scripts see, for formats whose tree is not SDFormat's nesting:
/// CoppeliaSim's, in which a joint is the parent of the shape that it moves. An object without a place is where
/// SDFormat nests it: a link, joint or frame below its model, a sensor below its link or joint. A place changes nothing
/// in the physics.
struct TreePlace {
  int id = 0;             ///< any number, unique among the places of a file: in a .ttt, the object's handle
  int parent = -1;        ///< `id` of the parent, of any kind, in any model of the file; -1: the top of the scene
  int order = 0;          ///< among its siblings, lower first; equal ones are in the order of the description
  bool is_model = false;  ///< the base of a model: where `:` in paths leads from the objects below
  std::filesystem::path child_script{};  ///< empty: none
  std::string old_name{};                ///< unique in its file, such as `wheel#0`; empty: none
  std::vector<ScriptParameter> parameters{};
  std::map<std::string, std::string> data{};  ///< bytes that the file attaches to the object, by name
};

struct SensorDescription {
  std::string name;
  std::string alias;       ///< its name in paths; empty: the name
  std::string type;        ///< SDFormat's name, such as gpu_lidar
  Pose pose;               ///< in the frame of its link or joint; the sensor looks along its x axis
  double update_rate = 0;  ///< Hz; 0: every step
  SensorKind kind;
  std::vector<PluginDescription> plugins;
  std::string topic;  ///< topic to publish on; empty: its plugins may publish it
  std::string frame;  ///< frame_id of the messages; default: its link
  GzTopic gz;
  Source source;
  std::optional<TreePlace> place{};
};

struct LinkDescription {
  std::string name;
  std::string alias;                      ///< its name in paths; empty: the name
  bool gravity_enabled = true;            ///< gravity acts on it
  bool wind_enabled = false;              ///< the wind pushes it: see Wind
  double linear_decay = 0;                ///< 1/s, decay of its velocity: see VelocityDecay
  double angular_decay = 0;               ///< 1/s, decay of its angular velocity
  Pose pose;                              ///< in the model's frame
  std::optional<Pose> start{};            ///< initial pose, if it differs because of initial joint positions
  std::optional<Twist> start_velocity{};  ///< of the link's origin, world axes; at rest when not set
  double mass = 1;
  Vector3 centre_of_mass;  ///< in the link's frame
  /// About the centre of mass, along the link's axes: xx, yy, zz, then xy, xz, yz. kg m^2
  Vector3 inertia_diagonal = Vector3::Ones();
  Vector3 inertia_products;
  std::vector<CollisionDescription> collisions;
  std::vector<VisualDescription> visuals;
  std::vector<SensorDescription> sensors;
  std::vector<Light> lights;  ///< positions and directions in the link's frame
  Source source;
  std::optional<TreePlace> place{};
  /// Of a static model: the link of another model with which it moves, by name; empty: it stays. Names of links that
  /// carry others are unique in the scene.
  std::string carrier{};

  Matrix3 inertia() const {
    const Vector3& d = inertia_diagonal;
    const Vector3& p = inertia_products;
    return Matrix3{{d.x(), p.x(), p.y()}, {p.x(), d.y(), p.z()}, {p.y(), p.z(), d.z()}};
  }
};

enum class MotorMode {
  kNone,      ///< no motor; friction and damping act
  kVelocity,  ///< holds a target velocity
  kPosition,  ///< moves to a target position and holds it
  kEffort,    ///< exerts a target effort
};

/// An axis that follows another axis: position = multiplier * (leader's position - reference) + offset.
struct MimicDescription {
  std::string joint;  ///< of the same model
  int axis = 0;       ///< of the leader
  double multiplier = 1;
  double offset = 0;     ///< rad or m
  double reference = 0;  ///< rad or m
};

/// 1/s; a position motor reduces its error with a time constant of one default simulation step.
constexpr double kPositionGain = 20;

struct AxisDescription {
  Vector3 direction = Vector3::UnitZ();  ///< unit length, in the joint's frame
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  double max_force = std::numeric_limits<double>::infinity();     ///< of the motor; N or N m
  double max_velocity = std::numeric_limits<double>::infinity();  ///< of the motor; m/s or rad/s
  double friction = 0;                                            ///< N or N m, against any motion
  double damping = 0;                                             ///< N s/m or N m s/rad
  double spring_stiffness = 0;                                    ///< N/m or N m/rad
  double spring_reference = 0;                                    ///< m or rad, rest position of the spring
  MotorMode motor = MotorMode::kNone;
  double target = 0;                      ///< of the motor at the start: rad or m, rad/s or m/s, N m or N
  double position_gain = kPositionGain;   ///< 1/s, of a position motor: its speed per position error
  std::optional<MimicDescription> mimic;  ///< replaces the motor's targets
  bool by_callback = false;               ///< the callback sysCall_joint of a script drives it
};

struct JointDescription {
  std::string name;
  std::string alias;   ///< its name in paths; empty: the name
  std::string type;    ///< SDFormat's name: see joint_kinds() in src/sim/physics/joints
  std::string parent;  ///< link of the same model, or "world"
  std::string child;
  Pose pose;  ///< in the model's frame
  std::vector<AxisDescription> axes;
  std::vector<SensorDescription> sensors;  ///< force-torque sensors
  double screw_lead = 1;                   ///< m per turn, motion of a screw's child along the axis
  double gearbox_ratio = 1;                ///< child angle = -ratio * parent angle, both relative to the reference link
  std::string gearbox_reference;           ///< link that both are attached to by hinges, or "world"
  Source source;
  std::optional<TreePlace> place{};
};

/// What scripts see a frame as.
enum class FrameKind {
  kDummy,
  kShape,  ///< a part of a link that is an object of its own: its visuals and collisions are the link's
  kCamera,
  kLight,
  kGraph,
  kScript,
  kJoint,  ///< without physics: what is below it in the tree moves when its position is set
};

/// 'dummy', 'shape' ...
std::string_view frame_kind_name(FrameKind kind);

/// An object without physics: it moves with a link, or stays in the world until a script moves it.
struct FrameDescription {
  std::string name;   ///< unique in its model: links, joints, nested models and frames; in the scene: models and frames
  std::string alias;  ///< its name in paths; empty: the name
  FrameKind kind = FrameKind::kDummy;
  std::string link;  ///< of the same model, which carries it; empty: the world
  Pose pose;         ///< in the frame of that link, or in the world
  Source source;
  std::optional<TreePlace> place{};
  /// Of a joint: its name, type (revolute, continuous, prismatic, screw, ball), limits, and its leader, a joint
  /// anywhere in the scene, as the mimic of its axis. It turns about the z axis of the frame, or slides along it.
  std::optional<JointDescription> joint{};
  double joint_position = 0;  ///< of a joint, at the start: rad or m
};

/// A nested model. Its links and joints are in the lists of the outermost model, named `inner::link`.
struct NestedModelDescription {
  std::string name;  ///< relative to the outermost model: `inner`, `inner::deeper`; outer models come before inner ones
  std::string alias;  ///< its name in paths; empty: the last part of the name
  Pose pose;          ///< in the outermost model's frame
  std::string canonical_link;
  std::filesystem::path child_script;  ///< empty: none
  std::vector<PluginDescription> plugins;
  Source source;
};

/// The axes that scripts and remote clients see of joints, proximity sensors and cameras.
enum class AxisConvention {
  kSdformat,     ///< as in the file: sensors look along x
  kCoppeliaSim,  ///< joints move along or about z, sensors look along z with y up
};

/// A <gripper>: see Grasp, whose updates are the physics substeps.
struct GripperDescription {
  std::string name;
  std::string palm;                  ///< link of the model
  std::vector<std::string> fingers;  ///< likewise
  int min_contacts = 2;
  int attach_steps = 20;
  int detach_steps = 40;
  Source source;
};

struct Waypoint {
  double time = 0;  ///< s, from the start of its trajectory
  Pose pose;        ///< in the world
};

/// A part of a script: it begins where its first waypoint is, and ends at the time of its last one.
struct Trajectory {
  double tension = 0;               ///< of its spline: 0 is Catmull-Rom's, 1 comes to rest at each waypoint
  std::vector<Waypoint> waypoints;  ///< at ascending times
};

/// The motion of a static model: see ScriptedMotion.
struct MotionScript {
  bool loop = true;
  double delay = 0;  ///< s, before each cycle
  std::vector<Trajectory> trajectories;
};

struct ModelDescription {
  std::string name;
  std::string alias;  ///< its name in paths; empty: the name
  Pose pose;          ///< in the world
  bool is_static = false;
  bool self_collide = false;
  AxisConvention axes = AxisConvention::kSdformat;
  std::string canonical_link;
  std::vector<LinkDescription> links;
  std::vector<JointDescription> joints;
  std::vector<NestedModelDescription> nested;
  std::filesystem::path child_script;  ///< empty: none
  std::vector<PluginDescription> plugins;
  std::vector<TransmissionDescription> transmissions;
  std::vector<GripperDescription> grippers{};
  std::optional<MotionScript> script{};
  Source source;
  std::vector<FrameDescription> frames;
  /// Whether scripts see the model itself. If not, it is only what moves together: in the tree are those of its parts
  /// that have a place, and the others have handles but no parent, no child and no path.
  bool is_object = true;
  /// Whether it was converted from a file of another simulator, which may have come from anywhere: its scripts in
  /// Python run only if that is allowed.
  bool is_foreign = false;
};

/// Reaction to a divergence of the physics.
enum class OnDivergence {
  kPause,   ///< the simulation pauses
  kReset,   ///< world reset
  kRemove,  ///< the model is removed
};

/// Who solves the joints and contacts of islands with joints.
enum class Solver {
  kOde,
  kBubblesim  ///< trees in generalised coordinates (docs/adr/0050), and ODE what trees do not know
};

/// A set of objects that a file has saved: its items add objects to it or remove them, one after the other.
struct CollectionDescription {
  enum class What { kObject, kTree, kChain, kAll };  ///< the object, all below, all above it, all of the scene
  struct Item {
    What what = What::kObject;
    int id = -1;  ///< the id of the object's place
    bool removes = false;
  };
  std::string name;
  std::vector<Item> items;
};

struct SceneDescription {
  std::string name;
  std::string world_name;  ///< of the <world>; the scene's name when the file has none
  std::filesystem::path file;
  Vector3 gravity{0, 0, -9.81};  ///< m/s^2
  double time_step = 0.05;       ///< s, of one simulation step
  double substep = 0.005;        ///< s, of one physics substep; divides time_step
  OnDivergence on_divergence = OnDivergence::kPause;
  Solver solver = Solver::kBubblesim;
  Environment environment;
  std::vector<ModelDescription> models;
  std::vector<FrameDescription> frames;  ///< of no model: they stay in the world
  std::vector<CollectionDescription> collections;
  std::vector<PluginDescription> plugins;
  std::vector<RandomQuantity> randomized;  ///< in each simulation, by its seed
  bool is_model_file = false;  ///< the file contains a model and no world; the model stands on a ground plane
  Source source;
};

}  // namespace bubblesim
