// SPDX-License-Identifier: BSD-3-Clause
// What a scene or model file of CoppeliaSim contains, as plain values. SI units, angles in radians.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "bubblesim/math.hpp"

namespace bubblesim::ttt {

using Rgb = std::array<double, 3>;

enum class PrimitiveKind { kNone, kPlane, kDisc, kCuboid, kSpheroid, kCylinder, kCone, kHeightfield, kCapsule };

using Vertices = std::vector<std::array<float, 3>>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// A mesh of a shape. Meshes share equal arrays.
struct Part {
  std::shared_ptr<const Vertices> vertices;    ///< in the part's frame; never null
  std::shared_ptr<const Triangles> triangles;  ///< counter-clockwise from outside; never null
  Pose frame;                                  ///< of the vertices and of the primitive, in the shape's frame
  PrimitiveKind primitive = PrimitiveKind::kNone;
  Vector3 size;           ///< of the primitive, full lengths
  bool has_hole = false;  ///< in the primitive
  bool is_convex = false;
  bool is_wireframe = false;  ///< only its edges are drawn
  bool is_one_sided = false;  ///< its back faces are not drawn
  Rgb color{0.7, 0.7, 0.7};   ///< ambient and diffuse
  Rgb emission{0, 0, 0};
  double opacity = 1;
  int texture = -1;                                       ///< id of a texture or handle of a vision sensor; -1: none
  bool is_decal = false;                                  ///< the texture replaces the colour
  std::vector<std::array<float, 2>> texture_coordinates;  ///< three a triangle, or empty: the texture is not shown
};

struct Shape {
  bool is_static = true;
  bool is_respondable = false;
  Vector3 velocity;                    ///< m/s, at the start, of the centre of mass, world axes
  Vector3 angular_velocity;            ///< rad/s, at the start, world axes
  unsigned respondable_mask = 0xffff;  ///< low byte: with shapes of the same tree, high byte: with others
  double mass = 0.001;
  Vector3 centre_of_mass;                 ///< in the shape's frame
  Matrix3 inertia = Matrix3::Identity();  ///< divided by the mass, about the centre of mass, in the shape's axes; m^2
  std::vector<double> ode;                ///< friction, soft ERP, soft CFM, linear, angular damping; empty: not given
  std::vector<double> bullet;             ///< restitution, old friction, friction ...; empty: not given
  std::vector<Part> parts;
};

enum class JointType { kRevolute = 10, kPrismatic = 11, kSpherical = 12 };
enum class JointControl { kFree = 0, kForce = 1, kVelocity = 4, kPosition = 8, kSpring = 12, kCallback = 16 };

struct Joint {
  JointType type = JointType::kRevolute;
  double position = 0;
  bool is_cyclic = false;
  double lower = 0;
  double upper = 0;
  double lead = 0;      ///< m per rad; not 0: a screw
  Quaternion rotation;  ///< of a spherical joint
  bool is_dynamic = false;
  bool is_dependent = false;
  int leader = -1;  ///< handle
  double factor = 1;
  double offset = 0;
  JointControl control = JointControl::kFree;
  double target_velocity = 0;
  double max_force = 0;
  double target_position = 0;
  double spring_stiffness = 0;
  double spring_damping = 0;
  double max_velocity = 0;                 ///< of motion profiles; 0: not given
  std::array<double, 3> gains{0.1, 0, 0};  ///< P, I, D of position control, in a step of the engine
};

enum class VolumeKind { kPyramid, kCylinder, kDisc, kCone, kRay, kRandomRay };

struct ProximitySensor {
  VolumeKind volume = VolumeKind::kRay;
  double offset = 0;
  double range = 1;
  Vector3 far_size;  ///< x and y
  double near_radius = 0;
  double far_radius = 0;
  double angle = 0;  ///< full opening
  double min_distance = 0;
  double max_normal_angle = 0;  ///< 0: any
  int entity = -1;              ///< handle of what is sensed; -1: all
};

struct VisionSensor {
  bool is_perspective = true;
  double width = 1;  ///< m, of an orthographic view
  double angle = 1;  ///< of the larger side
  double near = 0.01;
  double far = 10;
  int columns = 32;
  int rows = 32;
  bool has_filters = false;  ///< that change the image
};

struct ForceSensor {
  bool can_break = false;
};

struct Dummy {
  int linked = -1;    ///< handle
  int link_kind = 8;  ///< 0: closed loop
};

enum class LampKind { kPoint = 1, kSpot = 2, kDirectional = 3 };

struct Lamp {
  LampKind kind = LampKind::kPoint;
  bool is_on = true;
  Rgb diffuse{0.5, 0.5, 0.5};
  double cutoff = 1;
  std::array<double, 3> attenuation{1, 0, 0};
};

/// A path of V4.1 and earlier: control points, in its own frame.
struct Path {
  struct Point {
    Pose pose;
    double before = 0.5;  ///< how far the curve at the point reaches to the one before, as a part of the way; 0 to 1
    double after = 0.5;   ///< to the one after
    int count = 1;        ///< of the points on the curve; 1: a corner
  };
  bool is_closed = false;
  std::vector<Point> points;
};

/// An object of a kind that is kept only as a node of the tree.
struct Other {};

using Details = std::variant<Other, Shape, Joint, ProximitySensor, VisionSensor, ForceSensor, Dummy, Lamp, Path>;

/// A parameter of a script, as text.
struct Parameter {
  std::string name;
  std::string unit;
  std::string value;
};

struct Object {
  std::string tag;  ///< SHP, JNT ...
  int handle = -1;
  int parent = -1;  ///< handle; -1: none
  std::string alias;
  std::string old_name;  ///< unique, such as `wheel#0`; empty: not given
  Pose pose;             ///< relative to the parent's moving frame
  bool is_model = false;
  unsigned model_flags = 0;
  unsigned layers = 0;
  int order = -1;  ///< among siblings; -1: not given
  Details details;
  std::vector<Parameter> parameters{};        ///< of its script
  std::map<std::string, std::string> data{};  ///< custom data, by name

  template <class Kind>
  const Kind* as() const {
    return std::get_if<Kind>(&details);
  }
};

enum class ScriptKind { kMain = 0, kChild = 1, kCustomization = 6, kOther = -1 };

struct Script {
  int handle = -1;
  int object = -1;  ///< handle of the object that it acts for; -1: none
  int holder = -1;  ///< handle of the script object that it is; -1: it is a part of that object
  ScriptKind kind = ScriptKind::kOther;
  bool is_python = false;
  bool is_threaded = false;  ///< of old files
  bool is_disabled = false;
  bool is_default_main = false;
  std::string text;
  std::vector<Parameter> parameters{};
};

/// What an element of a collection stands for. Others are not known.
enum class ElementKind { kObject = 0, kTree = 1, kChain = 2, kAll = 5 };

/// A collection that the file has saved: its elements add objects to it or remove them, one after the other.
struct Collection {
  struct Element {
    ElementKind kind = ElementKind::kObject;
    int object = -1;  ///< handle
    bool adds = true;
  };
  int handle = -1;
  std::string name;
  std::vector<Element> elements;
};

struct Image {
  int id = -1;
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;
};

struct Settings {
  double time_step = 0.05;
  double engine_step = 0.005;
  Vector3 gravity{0, 0, -9.81};
  int engine = 0;  ///< 0 Bullet, 1 ODE, 2 Vortex, 3 Newton, 4 MuJoCo, 5 Drake
  bool is_dynamics_enabled = true;
  Rgb ambient{0.4, 0.4, 0.4};
  Rgb background{0.7, 0.7, 0.7};
  unsigned active_layers = 0xff;
};

struct DamagedPart {
  std::string object;  ///< alias; empty: no object
  std::string what;    ///< is wrong, and at which byte
};

struct SceneFile {
  int serialization = 0;
  int program_version = 0;
  bool is_scene = false;  ///< otherwise a model
  std::vector<Object> objects;
  std::vector<Script> scripts;
  std::vector<Image> images;
  std::vector<Collection> collections;
  Settings settings;
  std::map<std::string, int> left_out;  ///< what has no counterpart and is not an object, with its number
  std::vector<DamagedPart> damaged;     ///< what cannot be read, while the rest can
};

/// Reads the bytes of a file. What is wrong within an item is noted in `damaged`, and counts as missing. Throws
/// FormatError, which names the byte of the unpacked content, when the items of the file themselves cannot be found.
SceneFile read_scene_file(std::string_view file);

}  // namespace bubblesim::ttt
