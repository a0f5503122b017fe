// SPDX-License-Identifier: BSD-3-Clause
// The physical state of a scene: bodies, joints and shapes in ODE.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bubblesim/access_lock.hpp"
#include "bubblesim/math.hpp"
#include "bubblesim/prepared_scene.hpp"
#include "bubblesim/scene.hpp"
#include "bubblesim/scene_tree.hpp"
#include "bubblesim/state_archive.hpp"
#include "bubblesim/world_attachments.hpp"
#include "bubblesim/world_devices.hpp"
#include "bubblesim/world_frames.hpp"
#include "bubblesim/world_geometry.hpp"
#include "bubblesim/world_joints.hpp"
#include "bubblesim/world_measurements.hpp"
#include "bubblesim/world_models.hpp"
#include "bubblesim/world_properties.hpp"
#include "bubblesim/world_wrenches.hpp"

namespace bubblesim {

/// The functions of a subject are those of a part, as in `world.joints().position(joint)`.
///
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

  /// Another number after each addition and removal of a model, and after the first move of a static link.
  std::uint64_t revision() const;

  WorldModels& models() { return models_; }
  const WorldModels& models() const { return models_; }
  WorldFrames& frames() { return frames_; }
  const WorldFrames& frames() const { return frames_; }
  WorldJoints& joints() { return joints_; }
  const WorldJoints& joints() const { return joints_; }
  WorldProperties& properties() { return properties_; }
  const WorldProperties& properties() const { return properties_; }
  WorldWrenches& wrenches() { return wrenches_; }
  const WorldWrenches& wrenches() const { return wrenches_; }
  WorldAttachments& attachments() { return attachments_; }
  const WorldAttachments& attachments() const { return attachments_; }
  WorldDevices& devices() { return devices_; }
  const WorldMeasurements& measurements() const { return measurements_; }
  const WorldGeometry& geometry() const { return geometry_; }

  /// Resets the current models to their initial state: poses, velocities, joint targets and force limits. From here on
  /// the simulation equals that of a new world of these models, bit by bit. Clears a divergence.
  void reset();

  /// Whether no model was added or removed.
  bool has_scene_models() const;
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

  /// The links of static models that were moved since they were built.
  const std::set<ObjectId>& moved_statics() const;

  /// Pose in the world. The pose of a model is that of its frame, which moves with its canonical link. The pose of a
  /// joint is attached to the joint's parent, WorldJoints::child_pose() to its child.
  Pose pose(ObjectId object) const;
  /// Velocity of the object's origin.
  Twist velocity(ObjectId object) const;
  /// Acceleration of the object's origin, world axes: mean over the last advance(), including jumps of the velocity.
  Vector3 acceleration(ObjectId object) const;
  /// Moves a model (with all its links), a link, a sensor of a link or a frame to a pose, and what is below it in the
  /// tree along; velocities are kept. Static models may be moved, too: they stay where they are put.
  void set_pose(ObjectId object, const Pose& pose);
  /// Sets the velocity of a model or of a link, with what is below it in the tree: they move as one rigid body.
  void set_velocity(ObjectId object, const Twist& velocity);
  /// Drives a model in the plane as a whole, in m/s along the world's x and y and rad/s about its z, with a force of at
  /// most twenty times its mass, until the world is reset. The model may still fall, tilt and be stopped.
  void set_planar_velocity(ObjectId model, double x, double y, double turning);
  /// Sets pose and velocity together; on an error neither changes.
  void set_state(ObjectId object, const Pose& pose, const Twist& velocity);

  /// FNV-1a hash of the state: pose and velocity of each body and whether it sleeps, targets and modes of all motors,
  /// changed surfaces, attachments, applied wrenches, Device::state(), the seed and the state of the iterative
  /// solver. Equal histories give equal hashes in every process. Not covered: how long a body has been at rest, which
  /// ODE does not report.
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

 private:
  void build(const Scene& scene, std::uint64_t seed);

  WorldStateHandle state_;
  WorldModels models_{state_};
  WorldFrames frames_{state_};
  WorldJoints joints_{state_};
  WorldProperties properties_{state_};
  WorldWrenches wrenches_{state_};
  WorldAttachments attachments_{state_};
  WorldDevices devices_{state_};
  WorldMeasurements measurements_{state_};
  WorldGeometry geometry_{state_};
  std::shared_ptr<const std::string> start_;  // the physics of the scene's models at the start
  mutable AccessLock access_;
};

}  // namespace bubblesim
