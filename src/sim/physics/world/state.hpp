// SPDX-License-Identifier: BSD-3-Clause
// The state of a World: ODE's objects, and data that ODE does not store.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "bubblesim/error.hpp"
#include "bubblesim/scene.hpp"
#include "bubblesim/scene_tree.hpp"
#include "bubblesim/world.hpp"
#include "physics/contacts/island_solvers.hpp"
#include "physics/contacts/spaces.hpp"
#include "physics/contacts/substep.hpp"
#include "physics/contacts/touches.hpp"
#include "physics/ode/ode_math.hpp"
#include "physics/ode/ode_world.hpp"
#include "physics/parts/hold.hpp"
#include "physics/parts/placed_model.hpp"

namespace bubblesim {

class Fnv1a;

/// The state of a link at one time.
struct LinkState {
  ObjectId object = kNoObject;
  Pose pose;       // of its body
  Twist velocity;  // of its body
};
struct StateSample {
  double time = 0;  // s, age of the world
  std::vector<LinkState> links;
};

/// What pushes links, by link: the sum in world axes, the torque about the centre of mass.
using Wrenches = std::map<ObjectId, Wrench>;

/// A device and its schedule.
struct DeviceSlot {
  std::shared_ptr<Device> device;
  ObjectId model = kNoObject;  // with which it is removed
  double period = 0;           // s; 0 for each substep
  long substeps = 0;           // until its next update
  double ahead = 0;            // s from that update to the time at which it is due
  Wrenches wrenches;           // of its last update
};

/// An object without physics.
struct PlacedFrame {
  ObjectId link = kNoObject;  // that carries it; kNoObject: it stays in the world
  Pose pose;                  // in the frame of that link, or in the world
  FrameKind kind = FrameKind::kDummy;
  bool is_added = false;                    // by WorldFrames: it is in no description
  const FrameDescription* joint = nullptr;  // of a joint without physics; otherwise null
  std::shared_ptr<FrameDescription> own{};  // the same, of one that was added
  double position = 0;                      // of that joint, rad or m
  double velocity = 0;                      // with which it moves, rad/s or m/s
  ObjectId leader = kNoObject;              // the joint that it follows
};
/// Object::index of added frames.
constexpr std::size_t kAddedFrame = std::numeric_limits<std::size_t>::max();

/// Members are destroyed in reverse order: models and spaces before ODE's world.
struct WorldState {
  /// Creates the state without models.
  WorldState(const Vector3& gravity, std::uint64_t seed);

  Vector3 first_gravity;     // m/s^2, of the scene
  Vector3 gravity;           // m/s^2, at present
  double last_duration = 0;  // s, of the last advance()
  std::uint64_t seed;
  std::shared_ptr<const SceneTree> shared_tree;
  std::shared_ptr<SceneTree> own_tree;  // the same, if the world has changed it
  std::map<ObjectId, PlacedFrame> frames;
  std::shared_ptr<const std::vector<FrameDescription>> scene_frames;  // of no model, of the scene
  std::uint64_t revision = 0;                                         // counts additions and removals of models
  bool has_scene_models = true;

  Solver solver = Solver::kBubblesim;
  OdeWorld ode;
  Spaces spaces;
  std::vector<std::unique_ptr<PlacedModel>> models;  // in the order in which they were added
  Holds holds;
  AttachmentId attachments_made = 0;   // since the reset
  std::vector<PlacedModel*> model_at;  // by SceneTree::index_of(); null for other objects
  MovingModels moving;
  std::vector<Collider*> colliders;  // by Collider::number
  Wrenches wrenches;                 // of the next advance()
  std::vector<DeviceSlot> devices;   // in the order of their updates
  DeviceSlot* updating = nullptr;    // the device whose update runs
  Contacts contacts;                 // of the last substep
  Touches touches;                   // of the last advance()
  IslandSolvers solvers;
  double bottom = 0;                  // m along gravity, lowest initial position of all models and static shapes
  double age = 0;                     // s since construction
  std::vector<StateSample> history;   // of the last calls of advance()
  std::vector<ObjectId> lost_models;  // models that diverged
  bool diverged = false;
  bool interrupted = false;          // ODE threw in the middle of a step
  bool statics_stale = false;        // a static model was removed since gather_statics()
  std::set<ObjectId> moved_statics;  // links of static models that were ever moved

  const SceneTree& tree() const { return *shared_tree; }
  /// Throws WrongObject for a frame that is part of no model.
  PlacedModel& model_of(ObjectId id) { return *model_at[place_of_model(id)]; }
  const PlacedModel& model_of(ObjectId id) const { return *model_at[place_of_model(id)]; }
  const Link& link(ObjectId id) const { return model_of(id).links[tree().at(id).index]; }
  Link& link(ObjectId id) { return model_of(id).links[tree().at(id).index]; }
  const ModelFrame& frame(ObjectId id) const {
    const Object& object = tree().at(id);
    return object.is_outermost_model() ? model_of(id).frame : model_of(id).nested[object.index];
  }
  std::size_t place_of_model(ObjectId id) const {
    const ObjectId model = tree().outermost_model_of(id);
    if (model == kNoObject) throw WrongObject(shown(id) + " is a frame that is not a part of a model");
    return SceneTree::index_of(model);
  }
  std::string shown(ObjectId id) const { return tree().short_path(id); }
};

/// Throws Diverged when the physics diverged earlier.
void check_not_diverged(const WorldState& state);

/// Pose and velocity of an object in the world, see World::pose() and World::velocity().
Pose pose_of(const WorldState& state, ObjectId object);
Twist velocity_of(const WorldState& state, ObjectId object);
/// Moves an object and what is below it in the tree, see World::set_pose().
void move_object(WorldState& state, ObjectId object, const Pose& pose);
/// Moves what is below an object in the tree from one frame to another.
void move_children(WorldState& state, ObjectId parent, const Pose& before, const Pose& wanted);
/// Moves links, and what is below them in the tree, by a motion in the world.
void move_links(WorldState& state, const std::vector<ObjectId>& links, const Pose& motion);

/// Sets the pose of a link of a static model.
void place_static(WorldState& state, ObjectId link, const Pose& pose);
/// Moves the links of static models with the links that carry them.
void carry_statics(WorldState& state);
/// Lets a link of a static model move with another link from where it is now; kNoObject: it stays.
void attach_static(WorldState& state, ObjectId link, ObjectId carrier);
/// Attaches the links of a model to the carriers of their descriptions, which are built.
void attach_statics(WorldState& state, const PlacedModel& model);
/// Saves or restores where the links of static models are, and the sensors in their links.
void transfer_places(StateArchive& archive, WorldState& state);
void add_pose(Fnv1a& hash, const Pose& pose);
/// Adds what is not where its description has it.
void add_places(Fnv1a& hash, const WorldState& state);

/// Holds links as they are now, after some of them were put elsewhere.
void hold_moved(WorldState& state, const std::set<ObjectId>& links);
/// Ends the attachments of an outermost model that will be removed.
void forget_holds(WorldState& state, ObjectId model);
void transfer_holds(StateArchive& archive, WorldState& state);
void add_holds(Fnv1a& hash, const WorldState& state);

/// A joint without physics; null for other objects.
const PlacedFrame* kinematic_joint(const WorldState& state, ObjectId object);
PlacedFrame* kinematic_joint(WorldState& state, ObjectId object);
/// From the frame of such a joint to that of what it moves.
Pose motion_of(const PlacedFrame& joint);
/// Moves what is below such a joint in the tree, and the joints that follow it.
void set_kinematic_position(WorldState& state, ObjectId joint, double position);
/// Finds the leaders of the joints without physics, when all models are built.
void find_leaders(WorldState& state);
/// Moves the joints that have a velocity, and those that follow a joint with physics.
void move_kinematic_joints(WorldState& state, double duration);

/// The tree, to change it: a copy of the scene's, made at the first change.
SceneTree& changing_tree(WorldState& state);
/// The link that carries an object; kNoObject for objects that are fixed to the world.
ObjectId carrier(const WorldState& state, const Object& object);

/// Puts the frames of a model, or those of the scene that are of no model, at the poses of their description.
void place_frames(WorldState& state, const PlacedModel& model);
void place_frames(WorldState& state, const std::vector<FrameDescription>& frames);
/// Leaves the frames that a model carries in the world, and forgets its own; before it is removed.
void forget_frames(WorldState& state, ObjectId model);
Pose frame_pose(const WorldState& state, const PlacedFrame& frame);
/// Saves or restores the frames that are in a description.
void transfer_frames(StateArchive& archive, WorldState& state);
void add_frames(Fnv1a& hash, const WorldState& state);

/// Builds a model whose objects are in the tree already. gather_statics() completes it when it is static.
void place_model(WorldState& state, ObjectId id, std::shared_ptr<const PreparedModel> model);
/// Updates the lists of moving models and their numbers, after models were added or removed.
void list_moving(WorldState& state);
/// Rebuilds the space of the static shapes with a fitting size.
void gather_statics(WorldState& state);
/// Wakes all models, after one was moved or removed that may support them.
void wake_all(WorldState& state);
/// Drops the remembered contacts of an outermost model that was moved or will be removed.
void forget_contacts(WorldState& state, ObjectId model);
/// Updates the lowest initial position by the present poses.
void lower_bottom(WorldState& state);

/// Sets the present gravity, and which models may sleep in it.
void apply_gravity(WorldState& state, const Vector3& gravity);
/// Saves or restores the masses of a model's links.
void transfer_masses(StateArchive& archive, PlacedModel& model);
/// Saves or restores the friction and the slip that were changed.
void transfer_surfaces(StateArchive& archive, WorldState& state);
void add_surfaces(Fnv1a& hash, const WorldState& state);
/// Saves or restores the physics without devices, seed and random numbers.
void transfer_physics(StateArchive& archive, WorldState& state);

/// Updates the devices that are due at the start of a substep.
void update_devices(World& world, WorldState& state, double time, double step);
/// Puts devices into the state of a world that was reset.
void reset_devices(World& world, std::vector<DeviceSlot> devices, WorldState& state);
/// Removes the devices of a model.
void remove_devices(WorldState& state, ObjectId model);

/// Passes forces and torques to ODE, which applies them in the next substep only.
void push_links(WorldState& state, const Wrenches& wrenches);
/// Removes the wrenches of links that do not exist any more.
void forget_wrenches(WorldState& state);

/// Clears what sensors measured in the last advance().
void clear_meters(WorldState& state);

}  // namespace bubblesim
