// SPDX-License-Identifier: BSD-3-Clause
// The physical state of a scene: bodies, joints and shapes in ODE.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bubblesim/access_lock.hpp"
#include "bubblesim/error.hpp"
#include "bubblesim/math.hpp"
#include "bubblesim/prepared_scene.hpp"
#include "bubblesim/scene.hpp"
#include "bubblesim/scene_tree.hpp"
#include "bubblesim/state_archive.hpp"

namespace bubblesim {

/// Result of a ray cast.
struct RayHit {
  double distance = 0;  ///< m, from the ray's origin
  Vector3 normal;       ///< of the surface, world axes
  ObjectId link = kNoObject;
};

/// A shape at its current pose, for drawings and tools.
struct PlacedShape {
  ObjectId link = kNoObject;
  bool is_static = false;
  Geometry geometry;
  Pose pose;  ///< in the world
};

/// A point where two shapes touch.
struct TouchPoint {
  Vector3 position;         ///< m, in the world
  double normal_force = 0;  ///< N
};

/// Force and torque on a body.
struct Wrench {
  Vector3 force;   ///< N
  Vector3 torque;  ///< N m
};

/// What an inertial measurement unit feels, in its axes: the specific force is the acceleration minus gravity.
struct Inertial {
  Vector3 angular_velocity;  ///< rad/s, at present, or filtered if the unit has a bandwidth
  Vector3 specific_force;    ///< m/s^2, mean over the last advance() in the axes of each substep, or filtered
};

void transfer(StateArchive& archive, Wrench& wrench);

/// The frame of the vectors of a wrench.
enum class WrenchFrame { kWorld, kObject };

class Device;

/// All setters check their arguments and throw InvalidInput, with object and value, before they change anything: an
/// invalid value never reaches the physics. A handle of no object throws NoSuchObject, a handle of another kind of
/// object WrongObject.
class World {
 public:
  /// Shares what is constant with the scene, which may be destroyed before.
  World(const Scene& scene, std::uint64_t seed);
  /// Throws SceneError when the scene cannot be built.
  World(SceneDescription scene, std::uint64_t seed);
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  /// Lock for callers that share the world with a simulating thread. The functions of World do not take it.
  AccessLock& access() const { return access_; }

  /// The tree of the current objects. Adding or removing a model invalidates the reference;
  /// handles remain valid.
  const SceneTree& tree() const;

  /// Another number after each addition and removal of a model.
  std::uint64_t revision() const { return revision_; }

  /// Adds a model at the pose of its description. Throws SceneError with all problems of the model, also when its name
  /// is taken, and Diverged after a divergence. Adds warnings to `warnings`, unless it is null.
  ObjectId add_model(ModelDescription model, std::vector<Problem>* warnings = nullptr);
  /// Removes a model with all its objects; their handles become invalid. Throws InvalidInput for objects of other kinds
  /// and for nested models, and Diverged after a divergence, unless the model is one of diverged_models().
  void remove_model(ObjectId model);
  /// Throws what remove_model() would throw.
  void check_removable(ObjectId model) const;
  /// The description of the object's model.
  const ModelDescription& description(ObjectId object) const;
  /// Throws WrongObject for objects of other kinds.
  const SensorDescription& sensor_description(ObjectId sensor) const;

  /// Resets the current models to their initial state: poses, velocities, joint targets and force limits. From here on
  /// the simulation equals that of a new world of these models, bit by bit. Clears a divergence.
  void reset();

  /// Whether no model was added or removed.
  bool has_scene_models() const { return has_scene_models_; }
  /// Builds the models of the scene again, instead of the current ones.
  void rebuild(const Scene& scene);
  /// Sets the seed of the iterative solver's random numbers, from now on.
  void set_seed(std::uint64_t seed);

  /// Simulates `duration` seconds in physics substeps of `step` seconds. Throws Diverged when a body leaves the finite
  /// world (over 1e6 m away or faster than 1e6 m/s); the world cannot be used until it is reset or diverged_models()
  /// are removed. `time` is the simulation time at the start, for devices; by default the time since the last reset.
  void advance(double duration, double step, std::optional<double> time = {});
  /// The models whose bodies left the finite world; empty when the physics failed as a whole.
  const std::vector<ObjectId>& diverged_models() const;
  /// Models of which all links are more than 1000 m below the lowest point of the world as built.
  std::vector<ObjectId> fallen_models() const;
  /// Writes the states of all links at the start of the last ten calls of advance(), as lines of comma-separated
  /// values.
  void write_last_states(std::ostream& out) const;

  /// Pose in the world. The pose of a model is that of its frame, which moves with its canonical link. The pose of a
  /// joint is attached to the joint's parent, `joint_child_pose` to its child.
  Pose pose(ObjectId object) const;
  Pose joint_child_pose(ObjectId joint) const;
  /// Velocity of the object's origin.
  Twist velocity(ObjectId object) const;
  /// Acceleration of the object's origin, world axes: mean over the last advance(), including jumps of the velocity.
  Vector3 acceleration(ObjectId object) const;
  Vector3 gravity() const;
  /// Sets the gravity, m/s^2, until the world is reset. All bodies wake.
  void set_gravity(const Vector3& gravity);
  /// Mass of a link, or of all links of a model, kg. Throws WrongObject for other objects.
  double mass(ObjectId object) const;
  /// Sets the mass of a link, or scales those of all links of a model to this sum, until the world is reset. The
  /// moments of inertia are scaled likewise, the centres of mass stay. Throws WrongObject for static models.
  void set_mass(ObjectId object, double mass);
  /// Coulomb friction coefficient mu of the first collision of a link, or of a model's links. Throws WrongObject for
  /// objects without collisions.
  double friction(ObjectId object) const;
  /// Sets the friction coefficient, in all directions, of all collisions of a link or of a model's links, until the
  /// world is reset. A contact has the lower one of its two collisions.
  void set_friction(ObjectId object, double mu);
  /// Moves a model (with all its links) or a single link to a pose; velocities are kept.
  void set_pose(ObjectId object, const Pose& pose);
  /// Sets the velocity of a model (all its links move as one rigid body) or of a single link.
  void set_velocity(ObjectId object, const Twist& velocity);
  /// Drives a model in the plane as a whole, in m/s along the world's x and y and rad/s about its z, with a force of at
  /// most twenty times its mass, until the world is reset. The model may still fall, tilt and be stopped.
  void set_planar_velocity(ObjectId model, double x, double y, double turning);
  /// Sets pose and velocity together; on an error neither changes.
  void set_state(ObjectId object, const Pose& pose, const Twist& velocity);

  /// Pushes a link, or the canonical link of a model, during the next advance(): with a force at `point`, by default
  /// the link's centre of mass, and with a torque. `frame` is that of all three vectors. They are converted now and
  /// then constant in world axes. Wrenches add up; a sleeping body wakes. A wrench that Device::update() applies acts
  /// until the device's next update instead.
  void apply_wrench(ObjectId object, const Wrench& wrench, const std::optional<Vector3>& point = {},
                    WrenchFrame frame = WrenchFrame::kWorld);
  /// Throws what apply_wrench() would throw.
  void check_wrench(ObjectId object, const Wrench& wrench, const std::optional<Vector3>& point = {}) const;
  /// Removes the forces or the torques applied so far, or both.
  void clear_wrench(ObjectId object, bool force = true, bool torque = true);

  /// Calls a device before physics substeps, after those added before it, until it is removed or `model` is; kNoObject
  /// for the world. `rate` in Hz; 0 for each substep. A rate that the substeps do not divide is kept in the mean.
  void add_device(std::shared_ptr<Device> device, ObjectId model = kNoObject, double rate = 0);
  /// Does nothing when the device was removed with its model.
  void remove_device(const Device& device);

  /// `axis` is 0, or 1 for the second axis of a revolute2 joint. Radians or metres. Angles are between -pi and pi,
  /// unless the limits of the joint reach beyond; then full turns are counted.
  double joint_position(ObjectId joint, int axis = 0) const;
  double joint_velocity(ObjectId joint, int axis = 0) const;
  /// Force or torque of an axis's motor on the child, N along the axis or N m about it, mean over the last advance();
  /// 0 for an axis without a motor.
  double motor_effort(ObjectId joint, int axis = 0) const;
  /// The links that a joint connects, the parent first; kNoObject is the world.
  std::pair<ObjectId, ObjectId> joint_links(ObjectId joint) const;
  /// Number of axes; 0 for a fixed or ball joint and for joints of a static model.
  int joint_axes(ObjectId joint) const;
  double target_position(ObjectId joint, int axis = 0) const;
  double target_velocity(ObjectId joint, int axis = 0) const;
  double target_effort(ObjectId joint, int axis = 0) const;
  double max_force(ObjectId joint, int axis = 0) const;
  MotorMode motor_mode(ObjectId joint, int axis = 0) const;
  /// Sets the motor mode until the world is reset. The targets are kept. Throws WrongObject for a gearbox, which has no
  /// motor.
  void set_motor_mode(ObjectId joint, MotorMode mode, int axis = 0);
  /// Targets apply in the motor's mode: a position in a position-controlled joint, a velocity in a velocity-controlled
  /// one, and a force or torque on the child in an effort-controlled one, where the force limit applies and the
  /// velocity limit does not.
  void set_target_position(ObjectId joint, double position, int axis = 0);
  void set_target_velocity(ObjectId joint, double velocity, int axis = 0);
  void set_target_effort(ObjectId joint, double effort, int axis = 0);
  void set_max_force(ObjectId joint, double force, int axis = 0);
  /// Factor between a target and what the motor does, 1 at first and after a reset: of its velocity, its effort, and in
  /// position control the speed with which it approaches. Throws InvalidInput for numbers below 0 and above 1000.
  void set_motor_gain(ObjectId joint, double gain, int axis = 0);
  double motor_gain(ObjectId joint, int axis = 0) const;
  /// Moves the links below a revolute, continuous or prismatic joint so that the joint has this position; the joint
  /// velocity is kept. Throws InvalidInput for other joint types and for a joint in a closed chain of links.
  void set_joint_position(ObjectId joint, double position);
  /// The joint's description in the scene.
  const JointDescription& joint_description(ObjectId joint) const;

  /// The contacts of a link during the last advance(). Only links with a contact sensor record them, for the collisions
  /// of the sensor; throws InvalidInput for other links.
  std::vector<Contact> contacts(ObjectId link) const;
  /// The contact points of all links in the last physics substep, also of those that sleep.
  std::vector<TouchPoint> contact_points() const;
  /// The wrench of a joint's child on its parent in world axes, about the joint's origin, mean over the last advance().
  /// Only joints with a force-torque sensor record it; throws InvalidInput for other joints.
  Wrench joint_wrench(ObjectId joint) const;
  /// The wrench of a force-torque sensor with the axes, origin and sign of its description, which it has at the start
  /// of each substep: mean over the last advance(), or filtered. Zero in static models.
  Wrench sensor_wrench(ObjectId sensor) const;
  /// What an inertial measurement unit feels.
  Inertial sensor_motion(ObjectId sensor) const;

  /// The nearest hit of a ray of length `max_distance`; the model `ignored_model` is ignored.
  std::optional<RayHit> cast_ray(const Vector3& origin, const Vector3& unit_direction, double max_distance,
                                 ObjectId ignored_model = kNoObject) const;
  std::vector<PlacedShape> shapes() const;
  /// The lights of links, at their current poses.
  std::vector<Light> link_lights() const;

  /// FNV-1a hash of the state: pose and velocity of each body and whether it sleeps, targets and modes of all motors,
  /// applied wrenches, Device::state(), the seed and the state of the iterative solver. Equal histories give equal
  /// hashes in every process. Not covered: how long a body has been at rest, which ODE does not report.
  std::uint64_t state_hash() const;

  /// Saves what a world must have so that the next two can be restored: the descriptions of those of `models` that were
  /// added, and the devices of `models` and of the world. Or compares it: throws InvalidInput when it differs. Throws
  /// Diverged when only a reset helps.
  void transfer_layout(StateArchive& archive, const std::vector<ObjectId>& models) const;
  /// Saves or restores the devices of `models` and of the world, and their schedules.
  void transfer_devices(StateArchive& archive, const std::vector<ObjectId>& models);
  /// Saves or restores all else that determines the future: the physics with its memory, motors, applied wrenches,
  /// random numbers. Throws InvalidInput for values that are not usable; the world must be reset or restored then.
  /// Saving throws Diverged after a divergence.
  void transfer(StateArchive& archive);

  struct State;  // see src/sim/physics/world/state.hpp

 private:
  void build(const Scene& scene, std::uint64_t seed);

  struct Discard {
    void operator()(State* state) const;
  };

  std::unique_ptr<State, Discard> state_;
  std::shared_ptr<const std::string> start_;  // the physics of the scene's models at the start
  mutable AccessLock access_;
  std::uint64_t revision_ = 0;
  bool has_scene_models_ = true;
};

}  // namespace bubblesim
