// SPDX-License-Identifier: BSD-3-Clause
// The state of a World: ODE's objects, and data that ODE does not store.
#pragma once

#include <ode/ode.h>

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bubblesim/scene.hpp"
#include "bubblesim/scene_tree.hpp"
#include "bubblesim/world.hpp"
#include "physics/ode/body_state.hpp"
#include "physics/contacts/contact_memory.hpp"
#include "physics/contacts/contact_solver.hpp"
#include "physics/contacts/found_contacts.hpp"
#include "physics/contacts/friction_iteration.hpp"
#include "physics/motion/impact.hpp"
#include "physics/contacts/islands.hpp"
#include "physics/joints/joint.hpp"
#include "physics/joints/motor_meter.hpp"
#include "physics/parts/motion_meter.hpp"
#include "physics/ode/ode_handles.hpp"
#include "physics/ode/ode_math.hpp"
#include "physics/parts/prepared_model.hpp"
#include "physics/parts/rotation.hpp"
#include "physics/motion/sleep.hpp"

namespace bubblesim {

/// A link. Static ones have no body and stay at `pose`.
struct Link {
  ode::BodyHandle body;
  double mass = 0;         // kg, at present; 0 without a body
  Vector3 centre_of_mass;  // body's origin, in the link's frame
  Pose pose;               // of static links, in the world
  ObjectId object = kNoObject;
  int number = 0;  // among the links of moving models
  Pose rest_pose;  // of the body, where it came to rest last
  Twist before;    // of the body, at the start of the last advance()
  Sweep sweep;
};

/// A collision shape. ODE's geom points back at it.
struct Collider {
  explicit Collider(const CollisionDescription& description)
      : name(description.name),
        geometry(description.geometry),
        given_surface(description.surface),
        in_link(description.pose) {}

  ode::GeomHandle geom;
  const CollisionMesh* mesh = nullptr;  // null for shapes that ODE has itself
  const Link* link = nullptr;
  const std::string& name;
  const Geometry& geometry;
  const Surface& given_surface;                // of the description
  std::unique_ptr<const Surface> own_surface;  // in its place, after a change
  const Pose& in_link;
  bool watched = false;         // observed by a contact sensor
  int island = Islands::kNone;  // index of its model in the islands; kNone when it is static
  int number = 0;               // in the order of the models, moving ones first
  double model_mass = 0;        // kg, of its outermost model; infinite when it is static

  const Surface& surface() const { return own_surface == nullptr ? given_surface : *own_surface; }
};

/// Feedback of one of ODE's joints after each substep.
struct JointReport {
  dJointID joint = nullptr;
  dJointFeedback feedback{};
};

/// A force-torque sensor of a joint: the wrench in its axes, substep by substep.
struct WrenchSignal {
  explicit WrenchSignal(const ForceTorqueDescription& description_)
      : description(description_), force(description.bandwidth), torque(description.bandwidth) {}

  const ForceTorqueDescription& description;
  std::size_t sensor = 0;  // Object::index
  Pose in_child;           // the sensor in the child link's frame
  SubstepSignal force;     // N
  SubstepSignal torque;    // N m, about the sensor's origin

  void transfer(StateArchive& archive) { archive(force, torque); }
};

/// Accumulates the wrench of a joint from the feedback of its ODE joints, which keep pointers to their reports.
struct WrenchAccumulator {
  std::deque<JointReport> reports;
  std::vector<WrenchSignal> signals;
  Wrench sum;  // over the substeps of the last advance(), N s and N m s
  // At the start of the substep, to which ODE's forces refer:
  Pose child;
  Quaternion parent;
  Vector3 child_centre;  // of mass, in the world
};

struct PlacedJoint {
  std::unique_ptr<Joint> joint;
  ObjectId object = kNoObject;
  ObjectId parent = kNoObject;  // links; kNoObject is the world
  ObjectId child = kNoObject;
  Pose in_parent;
  Pose in_child;
  std::unique_ptr<WrenchAccumulator> meter;               // null without a sensor
  std::vector<std::unique_ptr<MotorMeter>> motor_meters;  // by axis; null without a motor
};

/// Two shapes that touched during the last advance(); a contact sensor observes the first.
struct Touch {
  const Collider* watched = nullptr;
  const Collider* other = nullptr;
  Vector3 impulse;         // on the first, N s
  std::uint64_t step = 0;  // of the points
  std::vector<ContactPoint> points;
};

/// A pair of shapes in an island without joints.
struct FreePair {
  int island = Islands::kNone;
  const FoundPair* pair = nullptr;
  const RememberedPair* remembered = nullptr;  // null when the shapes did not touch before
};

/// Holds a planar velocity of a body; has no joints until it is used.
struct PlanarMotor {
  ode::JointHandle linear;
  ode::JointHandle angular;
};

/// The link that carries the frame of a model.
struct ModelFrame {
  ObjectId canonical_link = kNoObject;
  Pose in_canonical_link;
};

/// Distance of a body's centre of mass from one of its joints, m.
struct Lever {
  dBodyID body = nullptr;
  double length = 0;
};

/// A model with its ODE objects; links, joints and sensors by Object::index. Members are destroyed in reverse order:
/// joints and geoms before bodies.
struct PlacedModel {
  PlacedModel(ObjectId object_, std::shared_ptr<const PreparedModel> prepared_)
      : object(object_), prepared(std::move(prepared_)), description(*prepared->description) {}

  ObjectId object;
  std::shared_ptr<const PreparedModel> prepared;
  const ModelDescription& description;
  ModelFrame frame;
  std::vector<ModelFrame> nested;   // of the nested models
  std::deque<Link> links;           // a deque, because pointers to its elements are kept
  std::vector<Rotation> rotations;  // of the links with unequal moments of inertia
  ode::SpaceHandle space;           // its moving geoms, in World::State::movers; null when it is static
  std::deque<Collider> colliders;   // likewise
  std::vector<PlacedJoint> joints;
  std::vector<Lever> levers;
  std::vector<Pose> sensors;                         // in the frame of their link or joint
  std::map<std::size_t, MotionMeter> motion_meters;  // of its inertial measurement units, by their index in `sensors`
  PlanarMotor planar_motor;
  Rest rest;
};

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

/// A body as it was before a step.
struct KeptBody {
  dBodyID body;
  int island;
  BodyNumbers numbers;
};

/// A device and its schedule.
struct DeviceSlot {
  std::shared_ptr<Device> device;
  ObjectId model = kNoObject;  // with which it is removed
  double period = 0;           // s; 0 for each substep
  long substeps = 0;           // until its next update
  double ahead = 0;            // s from that update to the time at which it is due
  Wrenches wrenches;           // of its last update
};

struct World::State {
  /// Creates the state without models.
  State(const Vector3& gravity, std::uint64_t seed);

  Vector3 first_gravity;     // m/s^2, of the scene
  Vector3 gravity;           // m/s^2, at present
  double last_duration = 0;  // s, of the last advance()
  std::uint64_t seed;
  std::shared_ptr<const SceneTree> shared_tree;

  // Destroyed in reverse order: models and spaces before the world, its threading last.
  ode::ThreadingHandle threading;
  ode::WorldHandle world;
  ode::SpaceHandle movers;   // one space per moving model
  ode::SpaceHandle statics;  // geoms without a body, of finite size
  ode::SpaceHandle planes;   // infinite geoms would degrade the quadtree of the statics
  ode::JointGroupHandle contacts;
  std::vector<std::unique_ptr<PlacedModel>> models;  // in the order in which they were added
  std::vector<PlacedModel*> model_at;                // by SceneTree::index_of(); null for other objects
  Wrenches wrenches;                                 // of the next advance()
  std::vector<DeviceSlot> devices;                   // in the order of their updates
  DeviceSlot* updating = nullptr;                    // the device whose update runs
  std::vector<Touch> touches;                        // of the last advance()
  std::uint64_t steps = 0;                           // substeps started in the last advance()
  std::vector<PlacedModel*> moving;                  // the moving models; the index is that in the islands
  std::vector<Collider*> colliders;                  // by Collider::number
  FoundContacts found;                               // of the last substep
  ContactMemory memory;                              // of the last substep
  ContactMemory memory_before;                       // working memory
  std::vector<double> least_rest;                    // s, by island; working memory
  std::vector<FreePair> free_pairs;                  // of the last substep, by islands
  ContactSolver contact_solver;                      // of islands without joints
  FrictionIteration friction_iteration;              // of islands with joints
  std::vector<KeptBody> bodies_before;               // of the last exact step; working memory
  Islands islands;                                   // of the last substep; models by index
  double bottom = 0;                  // m along gravity, lowest initial position of all models and static shapes
  double age = 0;                     // s since construction
  unsigned long random;               // random state of the iterative solver
  std::deque<StateSample> history;    // of the last calls of advance()
  std::vector<ObjectId> lost_models;  // models that diverged
  bool diverged = false;
  bool interrupted = false;    // ODE threw in the middle of a step
  bool statics_stale = false;  // a static model was removed since gather_statics()

  const SceneTree& tree() const { return *shared_tree; }
  PlacedModel& model_of(ObjectId id) { return *model_at[SceneTree::index_of(tree().outermost_model_of(id))]; }
  const PlacedModel& model_of(ObjectId id) const {
    return *model_at[SceneTree::index_of(tree().outermost_model_of(id))];
  }
  const Link& link(ObjectId id) const { return model_of(id).links[tree().at(id).index]; }
  const ModelFrame& frame(ObjectId id) const {
    const Object& object = tree().at(id);
    return object.parent == kNoObject ? model_of(id).frame : model_of(id).nested[object.index];
  }
  std::string shown(ObjectId id) const { return tree().short_path(id); }
};

/// Adds a model and its objects to the tree.
ObjectId enter_model(SceneTree& tree, const ModelDescription& model);

/// Builds a model whose objects are in the tree already. gather_statics() completes it when it is static.
void place_model(World::State& state, ObjectId id, std::shared_ptr<const PreparedModel> model);

/// Updates the list of moving models and their indices in the islands, after models were added or removed.
void list_moving(World::State& state);

/// In kg, at present; infinite for a static model.
double total_mass(const PlacedModel& model);

/// Sets the mass of a body, with the moments of inertia of the description scaled to it.
void set_inertia(dBodyID body, const LinkDescription& link, double mass);
/// Sets the present mass of a moving link, and its moments of inertia.
void apply_mass(PlacedModel& model, Link& link, double mass);
/// Sets the present gravity, and which models may sleep in it.
void apply_gravity(World::State& state, const Vector3& gravity);
/// Updates the lowest initial position by the present poses.
void lower_bottom(World::State& state);
/// Saves or restores the masses of a model's links.
void transfer_masses(StateArchive& archive, PlacedModel& model);
/// Saves or restores the friction coefficients that were changed.
void transfer_frictions(StateArchive& archive, World::State& state);

/// Rebuilds the space of the static shapes with a fitting size.
void gather_statics(World::State& state);

/// Detects collisions, for a substep of `step` seconds. Wakes what is touched.
void find_contacts(World::State& state, double step);
/// Creates ODE's contact joints of what was found.
void join_contacts(World::State& state, double step);
/// Solves each island with the solver that suits it, and moves the bodies.
void solve(World::State& state, double step);
/// Takes the forces of the contacts after a substep, and remembers them.
void gather_contacts(World::State& state);

/// Requests feedback of a joint from now on.
std::unique_ptr<WrenchAccumulator> make_meter(dBodyID parent, dBodyID child);
/// Call before each substep.
void aim_meters(World::State& state);
/// Clears the sums at the start of an advance(), and accumulates ODE's feedback after each substep.
void forget_touches(World::State& state);
void forget_forces(World::State& state);
void gather_forces(World::State& state, double step);

/// Rotates the bodies with unequal moments of inertia: call before and after ODE's step.
void begin_rotations(World::State& state, double step);
void end_rotations(World::State& state, double step);

/// Adds a body of a joint at `anchor`, in the world, to the levers of its model.
void note_lever(PlacedModel& model, dBodyID body, const Vector3& anchor);
/// Sets the part of the errors of joints that the next substep corrects.
void correct_joints(const World::State& state, double step);

/// Updates the devices that are due at the start of a substep.
void update_devices(World& world, World::State& state, double time, double step);
/// Puts devices into the state of a world that was reset.
void reset_devices(World& world, std::vector<DeviceSlot> devices, World::State& state);
/// Removes the devices of a model.
void remove_devices(World::State& state, ObjectId model);
/// Saves or restores the physics without devices, seed and random numbers.
void transfer_physics(StateArchive& archive, World::State& state);

/// Creates the motor that holds the planar velocity of a model.
PlanarMotor make_planar_motor(const World::State& state, const PlacedModel& model);
/// Sets its force to that for the model's present mass.
void limit_planar_motor(const PlanarMotor& motor, const PlacedModel& model);

/// Passes forces and torques to ODE, which applies them in the next substep only.
void push_links(const World::State& state, const Wrenches& wrenches);
/// Removes the wrenches of links that do not exist any more.
void forget_wrenches(World::State& state);

/// Pose in the world.
Pose link_pose(const Link& link);

}  // namespace bubblesim
