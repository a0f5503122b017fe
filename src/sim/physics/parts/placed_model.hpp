// SPDX-License-Identifier: BSD-3-Clause
// A model with its objects in ODE.
#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "bubblesim/math.hpp"
#include "bubblesim/scene.hpp"
#include "bubblesim/scene_tree.hpp"
#include "physics/ode/ode_handles.hpp"
#include "physics/parts/collider.hpp"
#include "physics/parts/link.hpp"
#include "physics/parts/motion_meter.hpp"
#include "physics/parts/placed_joint.hpp"
#include "physics/parts/planar_motor.hpp"
#include "physics/parts/prepared_model.hpp"
#include "physics/parts/rotation.hpp"

namespace bubblesim {

class TreeModel;

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

/// How long a model has been at rest, and with which models it sleeps.
struct Rest {
  bool may_sleep = false;
  double time = 0;             // s
  ObjectId group = kNoObject;  // first model of the group; kNoObject: awake

  bool is_awake() const { return group == kNoObject; }
};

/// Links, joints and sensors by Object::index. Members are destroyed in reverse order: joints and geoms before bodies.
struct PlacedModel {
  PlacedModel(ObjectId object_, std::shared_ptr<const PreparedModel> prepared_)
      : object(object_), prepared(std::move(prepared_)), description(*prepared->description) {}

  ObjectId object;
  int number = 0;  // in MovingModels::all
  std::shared_ptr<const PreparedModel> prepared;
  const ModelDescription& description;
  ModelFrame frame;
  std::vector<ModelFrame> nested;   // of the nested models
  std::deque<Link> links;           // a deque, because pointers to its elements are kept
  std::vector<Rotation> rotations;  // of the links with unequal moments of inertia
  ode::SpaceHandle space;           // its moving geoms, in Spaces::movers or sleepers; null when it is static
  std::deque<Collider> colliders;   // likewise
  std::vector<PlacedJoint> joints;
  std::vector<Lever> levers;
  std::vector<Pose> sensors;  // in the frame of their link or joint
  std::vector<const SensorDescription*> described_sensors;
  std::map<std::size_t, MotionMeter> motion_meters;  // of its inertial measurement units, by their index in `sensors`
  PlanarMotor planar_motor;
  std::shared_ptr<TreeModel> trees;  // null until it is solved as such
  Rest rest;
};

/// The moving models of a world, in the order in which they were added.
struct MovingModels {
  std::vector<PlacedModel*> all;
  std::vector<PlacedModel*> awake;
  bool is_any_commanded = false;  // a sleeping body was enabled, see command()

  const PlacedModel& at(int number) const { return *all[static_cast<std::size_t>(number)]; }
};

/// Whether a joint holds its child to the world.
bool is_anchor(const PlacedModel& model, std::size_t joint);
/// Whether a joint turns about one axis.
bool is_hinge(const PlacedModel& model, std::size_t joint);
/// Whether a joint can be put elsewhere between its links: it is one of these.
bool has_loose_frame(const PlacedModel& model, std::size_t joint);
/// Puts such a joint elsewhere: poses of its frame in its parent (the world without one) and in its child. The links
/// stay.
void place_joint(PlacedModel& model, std::size_t joint, const Pose& in_parent, const Pose& in_child);

/// In kg, at present; infinite for a static model.
double total_mass(const PlacedModel& model);

/// Sets the present mass of a moving link, kg, and its moments of inertia.
void apply_mass(PlacedModel& model, Link& link, double mass);

/// The motor that holds the planar velocity of a model.
PlanarMotor make_planar_motor(dWorldID world, const PlacedModel& model);

}  // namespace bubblesim
