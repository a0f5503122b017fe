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
#include "bubblesim/math.hpp"
#include "bubblesim/scene.hpp"
#include "bubblesim/scene_tree.hpp"

namespace bubblesim {

/// What a ray hit.
struct RayHit {
  double distance = 0;  ///< m, from the ray's origin
  Vector3 normal;       ///< of the surface, world axes
  ObjectId link = kNoObject;
};

/// A shape as it stands now, for drawings and tools.
struct PlacedShape {
  ObjectId link = kNoObject;
  bool is_static = false;
  Geometry geometry;
  Pose pose;  ///< in the world
};

/// Where two shapes touch; world axes.
struct ContactPoint {
  Vector3 position;  ///< m
  Vector3 normal;    ///< in which the other shape pushes
  double depth = 0;  ///< m
  Vector3 force;     ///< N, in the physics substep in which they last touched
};

/// A shape of a link that touched another one while the last step went by.
struct Contact {
  std::string collision;
  ObjectId other_link = kNoObject;
  std::string other_collision;
  Vector3 force;                     ///< N on the link, the mean over the step
  std::vector<ContactPoint> points;  ///< of the physics substep in which they last touched
};

/// What one body does to another through a joint, world axes.
struct Wrench {
  Vector3 force;   ///< N
  Vector3 torque;  ///< N m, about the origin of the joint
};

/// All setters check what they are given and throw InvalidInput, naming object and value, before anything is changed:
/// a bad value never reaches the physics. A handle of no object throws NoSuchObject, that of another kind of object WrongObject.
class World {
 public:
  /// Throws InvalidInput when the scene asks for something that cannot be built.
  World(const SceneDescription& scene, std::uint64_t seed);
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  /// For those who use the world beside a thread that simulates; the functions here do not take it.
  AccessLock& access() const { return access_; }

  /// Refers to the world as it is now: a reset ends the reference, handles stay.
  const SceneTree& tree() const;

  /// Adds a model at the pose that it has in its description. Throws SceneError with all that is wrong with it, also
  /// when its name is taken; and Diverged when the world diverged.
  ObjectId add_model(ModelDescription model);
  /// Removes a model with all that belongs to it; the handles of these objects name nothing from now on. Throws
  /// InvalidInput for objects of other kinds and for models in others, and Diverged when the world diverged, unless the
  /// model is one of those that did.
  void remove_model(ObjectId model);
  /// Throws what remove_model() would throw.
  void check_removable(ObjectId model) const;
  /// Of the model that an object belongs to.
  const ModelDescription& description(ObjectId object) const;
  /// Throws WrongObject for objects of other kinds.
  const SensorDescription& sensor_description(ObjectId sensor) const;

  /// Puts the models that are there now back to where they came into the world: poses, velocities, joint targets and
  /// force limits. What follows equals what follows in a new world of these models, bit by bit. A world that diverged
  /// is of use again.
  void reset();

  /// Lets `duration` seconds pass in steps of `step` seconds. Throws Diverged when a body leaves the finite world
  /// (over 1e6 m away or faster than 1e6 m/s): the world is then of no use until it is reset, or diverged_models() are
  /// removed.
  void advance(double duration, double step);
  /// The models whose bodies left the finite world; none when the physics broke down as a whole.
  const std::vector<ObjectId>& diverged_models() const;
  /// Models that are with all their links more than 1000 m below everything that the world was built of.
  std::vector<ObjectId> fallen_models() const;
  /// Where all links were when the last ten calls of advance() began, a line each of comma-separated values.
  void write_last_states(std::ostream& out) const;

  /// Pose in the world. A model's is the one of its frame, carried by its canonical link; a joint's is attached to the
  /// joint's parent, `joint_child_pose` to its child.
  Pose pose(ObjectId object) const;
  Pose joint_child_pose(ObjectId joint) const;
  /// Velocity of the object's origin.
  Twist velocity(ObjectId object) const;
  /// Acceleration of the object's origin, world axes: the mean over the last advance(), which may have changed its
  /// velocity in jumps.
  Vector3 acceleration(ObjectId object) const;
  Vector3 gravity() const;
  /// Puts a model (with all its links) or a single link somewhere else; velocities are kept.
  void set_pose(ObjectId object, const Pose& pose);
  /// Of a model (all its links move as one rigid body) or a single link.
  void set_velocity(ObjectId object, const Twist& velocity);
  /// Has a model move in the plane as a whole, m/s along the world's x and y and rad/s about its z, pushed by as much
  /// as twenty times its mass, until the world is reset. It may still fall, tilt and be stopped.
  void set_planar_velocity(ObjectId model, double x, double y, double turning);
  /// Both at once, or none.
  void set_state(ObjectId object, const Pose& pose, const Twist& velocity);

  /// `axis` is 0, or 1 for the second axis of a revolute2 joint. Radians or metres. Positions of turning joints lie
  /// between -pi and pi, unless their limits reach beyond: then whole turns count.
  double joint_position(ObjectId joint, int axis = 0) const;
  double joint_velocity(ObjectId joint, int axis = 0) const;
  /// What the motor of an axis did to the child, N along the axis or N m about it, as the mean over the last advance().
  /// It is measured from the first call on, which returns 0; so do those for an axis without a motor.
  double motor_effort(ObjectId joint, int axis = 0);
  /// The links that a joint connects, the parent first; kNoObject is the world.
  std::pair<ObjectId, ObjectId> joint_links(ObjectId joint) const;
  /// How many there are; none of a fixed or ball joint, nor of one that belongs to a static model.
  int joint_axes(ObjectId joint) const;
  double target_position(ObjectId joint, int axis = 0) const;
  double target_velocity(ObjectId joint, int axis = 0) const;
  double max_force(ObjectId joint, int axis = 0) const;
  /// Until the world is reset. The targets stay.
  void set_motor_mode(ObjectId joint, MotorMode mode, int axis = 0);
  /// A target takes effect in the motor's mode: a position in a position-controlled joint, a velocity in the others.
  void set_target_position(ObjectId joint, double position, int axis = 0);
  void set_target_velocity(ObjectId joint, double velocity, int axis = 0);
  void set_max_force(ObjectId joint, double force, int axis = 0);
  /// Moves what hangs on a revolute, continuous or prismatic joint there at once, as if by hand; it keeps its velocity.
  /// InvalidInput for joints of other types, and for one in a closed chain of links.
  void set_joint_position(ObjectId joint, double position);
  /// As the scene describes it; `axis` as above.
  const JointDescription& joint_description(ObjectId joint) const;

  /// What a link touched during the last advance(). Only links with a contact sensor keep it, each for the shapes that
  /// the sensor names; InvalidInput for others.
  std::vector<Contact> contacts(ObjectId link) const;
  /// What a joint's child does to its parent, the mean over the last advance(); only joints with a force-torque sensor
  /// keep it, InvalidInput for others.
  Wrench joint_wrench(ObjectId joint) const;

  /// The nearest thing that a ray of length `max_distance` meets, leaving out the model `ignored_model`.
  std::optional<RayHit> cast_ray(const Vector3& origin, const Vector3& unit_direction, double max_distance,
                                 ObjectId ignored_model = kNoObject) const;
  std::vector<PlacedShape> shapes() const;
  /// The lights of links, where they are now.
  std::vector<Light> link_lights() const;

  /// FNV-1a hash of the state: pose and velocity of each body and whether it sleeps, targets and modes of all motors,
  /// the seed and the state of the iterative solver. Equal histories give equal hashes in every process. It leaves out
  /// how long a body has been at rest, which ODE does not tell.
  std::uint64_t state_hash() const;

  struct State;  // see src/sim/world_state.hpp

 private:
  struct Discard {
    void operator()(State* state) const;
  };

  std::unique_ptr<State, Discard> state_;
  mutable AccessLock access_;
};

}  // namespace bubblesim
