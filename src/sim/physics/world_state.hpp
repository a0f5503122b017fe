// SPDX-License-Identifier: BSD-3-Clause
// What a World holds: ODE's objects and, beside them, what ODE does not know.
#pragma once

#include <ode/ode.h>

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bubblesim/scene.hpp"
#include "bubblesim/scene_tree.hpp"
#include "bubblesim/world.hpp"
#include "physics/collision_mesh.hpp"
#include "physics/contact_thinning.hpp"
#include "physics/islands.hpp"
#include "physics/joints/joint.hpp"
#include "physics/ode_handles.hpp"

namespace bubblesim {

/// A link. Static ones have no body and stay at `pose`.
struct Link {
  ode::BodyHandle body;
  Vector3 centre_of_mass;  // body's origin, in the link's frame
  Pose pose;               // of static links, in the world
  ObjectId object = kNoObject;
  Twist before;  // the body's, when the last advance() began
};

/// A collision shape. ODE's geom points back at it.
struct Collider {
  std::shared_ptr<const CollisionMesh> mesh;  // what the geom reads, if it is one
  ode::GeomHandle geom;
  const Link* link = nullptr;
  std::string name;
  Geometry geometry;
  Surface surface;
  Pose in_link;
  bool watched = false;         // a contact sensor wants to know what it touches
  int island = Islands::kNone;  // number of its model there; none when it is static
};

/// What ODE tells about one of its joints after each step.
struct JointReport {
  dJointID joint = nullptr;
  dJointFeedback feedback{};
};

/// What a joint transmits, told by those of ODE's joints that it consists of. These keep pointers to their reports.
struct WrenchAccumulator {
  std::deque<JointReport> reports;
  Wrench sum;  // over the steps of the last advance(), N s and N m s
};

/// What the motor of an axis does. ODE's joint keeps a pointer to the feedback.
struct MotorMeter {
  int axis = 0;
  bool slides = false;
  dJointID joint = nullptr;
  dJointFeedback feedback{};
  Vector3 along;   // the axis when the step begins, which ODE's forces belong to; world axes
  Vector3 lever;   // from the joint's origin to the child's centre of mass then
  double sum = 0;  // over the steps of the last advance(), N s or N m s
};

struct PlacedJoint {
  std::unique_ptr<Joint> joint;
  ObjectId object = kNoObject;
  ObjectId parent = kNoObject;  // links; kNoObject is the world
  ObjectId child = kNoObject;
  Pose in_parent;
  Pose in_child;
  std::unique_ptr<WrenchAccumulator> meter;               // null when no sensor wants to know
  std::vector<std::unique_ptr<MotorMeter>> motor_meters;  // of axes that somebody asked for
};

/// Two shapes, of which a contact sensor watches the first, that touched during the last advance().
struct Touch {
  const Collider* watched = nullptr;
  const Collider* other = nullptr;
  Vector3 impulse;         // on the first, N s
  std::uint64_t step = 0;  // of the points
  std::vector<ContactPoint> points;
};

/// One of ODE's contact joints at a shape that is watched.
struct TouchReport {
  const Collider* first = nullptr;
  const Collider* second = nullptr;
  dJointID joint = nullptr;
  dContactGeom contact{};
  dJointFeedback feedback{};
};

/// Holds a velocity of a body in the plane; without joints until somebody wants one.
struct PlanarMotor {
  ode::JointHandle linear;
  ode::JointHandle angular;
};

/// What carries the frame of a model.
struct ModelFrame {
  ObjectId canonical_link = kNoObject;
  Pose in_canonical_link;
};

/// A model with what ODE has of it; links, joints and sensors by Object::index. Members are destroyed in the reverse
/// order: joints and geoms before bodies.
struct PlacedModel {
  ModelDescription description;
  ModelFrame frame;
  std::vector<ModelFrame> nested;  // of the models in it
  std::deque<Link> links;          // a deque, for pointers to its elements are kept
  ode::SpaceHandle space;          // its moving geoms, inside World::State::movers; null when it is static
  std::deque<Collider> colliders;  // too
  std::vector<PlacedJoint> joints;
  std::vector<Pose> sensors;  // in the frame of their link or joint
  PlanarMotor planar_motor;
};

/// A link at some moment.
struct LinkState {
  ObjectId object = kNoObject;
  Pose pose;       // of its body
  Twist velocity;  // of its body
};
struct StateSample {
  double time = 0;  // s, of the world's age
  std::vector<LinkState> links;
};

struct World::State {
  /// Without any model.
  State(const Vector3& gravity, std::uint64_t seed);

  Vector3 gravity;           // m/s^2
  double last_duration = 0;  // s, of the last advance()
  std::uint64_t seed;
  SceneTree tree;

  // Destroyed in the reverse order: models and spaces before the world, its threading last.
  ode::ThreadingHandle threading;
  ode::WorldHandle world;
  ode::SpaceHandle movers;   // one space for each model that moves
  ode::SpaceHandle statics;  // geoms without a body, of finite size
  ode::SpaceHandle planes;   // infinite ones would spoil the tree of the statics
  ode::JointGroupHandle contacts;
  std::map<ObjectId, PlacedModel> models;
  std::deque<TouchReport> touch_reports;  // of this step; a deque, for ODE keeps pointers to them
  std::vector<Touch> touches;             // of the last advance()
  std::uint64_t steps = 0;                // begun in the last advance()
  std::vector<PlacedModel*> moving;       // the models that move, by their number in the islands
  std::vector<FoundContact> found;        // of the last substep
  Islands islands;                        // of the last substep; models by their number
  double bottom = 0;                      // m along gravity, the lowest place that a model or static shape was made at
  double age = 0;                         // s since it was built
  int steps_to_iterate = 0;               // after the exact solver found no solution
  unsigned long random;                   // state of the iterative solver's random numbers
  std::deque<StateSample> history;        // the last steps
  std::vector<ObjectId> lost_models;      // those that diverged
  bool diverged = false;
  bool interrupted = false;  // ODE threw in the middle of a step

  const PlacedModel& model_of(ObjectId id) const { return models.at(tree.outermost_model_of(id)); }
  const Link& link(ObjectId id) const { return model_of(id).links[tree.at(id).index]; }
  const ModelFrame& frame(ObjectId id) const {
    const Object& object = tree.at(id);
    return object.parent == kNoObject ? models.at(id).frame : model_of(id).nested[object.index];
  }
  std::string shown(ObjectId id) const { return tree.short_path(id); }
};

/// Enters a model and its objects into the tree.
ObjectId enter_model(SceneTree& tree, const ModelDescription& model);

/// Builds a validated model whose objects are in the tree already. gather_statics() completes it when it is static.
void place_model(World::State& state, ObjectId id, ModelDescription model);

/// Lists the models that move and gives them their numbers in the islands, after models came or went.
void list_moving(World::State& state);

/// Wakes all that sleeps, after something was moved or taken away on which it may lie.
void wake(World::State& state);

/// Puts all static shapes into a space that fits them.
void gather_statics(World::State& state);

/// Finds what touches and makes ODE's contact joints for it, for a substep of `step` seconds.
void find_contacts(World::State& state, double step);

/// Has ODE report on a contact joint between two shapes when a sensor watches one of them.
void watch_contact(World::State& state, dJointID joint, const Collider& first, const Collider& second,
                   const dContactGeom& contact);
/// Has ODE report on a joint from now on.
std::unique_ptr<WrenchAccumulator> make_meter(dBodyID parent, dBodyID child);
/// The meter of an axis's motor, which measures from now on; null when it has no motor.
const MotorMeter* motor_meter(PlacedJoint& placed, int axis, bool slides);
/// Has its motor meters know where they are, before a step.
void aim_motor_meters(const World::State& state, const PlacedJoint& placed);
/// Forget, at the begin of an advance(), and take in, after each step of it, what ODE reports.
void forget_forces(World::State& state);
void gather_forces(World::State& state, double step);

Vector3 to_vector(const dReal* values);

/// Pose of an ODE body, whose origin is its centre of mass.
Pose body_pose(dBodyID body);
/// Of its centre of mass.
Twist body_velocity(dBodyID body);

/// In the world.
Pose link_pose(const Link& link);

}  // namespace bubblesim
