// SPDX-License-Identifier: BSD-3-Clause
// What a World holds: ODE's objects and, beside them, what ODE does not know.
#pragma once

#include <ode/ode.h>

#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "bubblesim/scene.hpp"
#include "bubblesim/scene_tree.hpp"
#include "bubblesim/world.hpp"
#include "joints/joint.hpp"
#include "ode_handles.hpp"

namespace bubblesim {

/// A collision shape. ODE's geom points back at it.
struct Collider {
  dGeomID geom = nullptr;
  ObjectId link = kNoObject;
  ObjectId model = kNoObject;
  Geometry geometry;
  Surface surface;
  Pose in_link;
};

/// A link. Static ones have no body and stay at `pose`.
struct Link {
  dBodyID body = nullptr;
  Vector3 centre_of_mass;  // body's origin, in the link's frame
  Pose pose;               // of static links, in the world
  ObjectId object = kNoObject;
};

struct PlacedJoint {
  std::unique_ptr<Joint> joint;
  ObjectId object = kNoObject;
  ObjectId parent = kNoObject;  // links; kNoObject is the world
  ObjectId child = kNoObject;
  Pose in_parent;
  Pose in_child;
};

struct PlacedModel {
  Pose in_canonical_link;  // model frame in its canonical link's frame
  ObjectId canonical_link = kNoObject;
  std::vector<ObjectId> links;
  dSpaceID space = nullptr;  // its moving geoms, inside World::State::movers
  bool self_collide = false;
};

struct World::State {
  State();
  ~State();

  SceneTree tree;
  std::vector<PlacedModel> models;  // by Object::index, as the following ones
  std::vector<Link> links;
  std::vector<PlacedJoint> joints;
  std::vector<Pose> sensors;       // in their link's frame
  std::deque<Collider> colliders;  // a deque: ODE's geoms keep pointers to its elements

  // Destroyed in the reverse order: contacts and spaces before the world, its threading last.
  ode::ThreadingHandle threading;
  ode::WorldHandle world;
  ode::SpaceHandle movers;   // one space for each model that moves
  ode::SpaceHandle statics;  // geoms without a body, of finite size
  ode::SpaceHandle planes;   // infinite ones would spoil the tree of the statics
  ode::JointGroupHandle contacts;
  std::uint64_t seed = 0;
  bool diverged = false;
  bool interrupted = false;  // ODE threw in the middle of a step

  const Link& link(ObjectId id) const { return links[tree.at(id).index]; }
  Pose link_pose(ObjectId id) const;
  std::string shown(ObjectId id) const { return tree.short_path(id); }
};

/// Fills the state from a validated scene.
void build_world(World::State& state, const SceneDescription& scene);

/// Finds what touches and makes ODE's contact joints for it.
void find_contacts(World::State& state);

Vector3 to_vector(const dReal* values);

/// Pose of an ODE body, whose origin is its centre of mass.
Pose body_pose(dBodyID body);

}  // namespace bubblesim
