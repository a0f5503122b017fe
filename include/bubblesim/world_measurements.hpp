// SPDX-License-Identifier: BSD-3-Clause
// What sensors of contacts, forces and inertia measure.
#pragma once

#include <vector>

#include "bubblesim/math.hpp"
#include "bubblesim/scene_tree.hpp"
#include "bubblesim/sensor_kinds.hpp"
#include "bubblesim/world_part.hpp"
#include "bubblesim/wrench.hpp"

namespace bubblesim {

/// A point where shapes of two links touch; world axes.
struct TouchPoint {
  ObjectId first = kNoObject;   ///< link
  ObjectId second = kNoObject;  ///< link
  Vector3 position;             ///< m
  Vector3 normal;               ///< direction in which the second link pushes the first
  double normal_force = 0;      ///< N
  Vector3 force;                ///< N, on the first link, with friction
};

/// What an inertial measurement unit measures, in its axes: the specific force is the acceleration minus gravity.
struct Inertial {
  Vector3 angular_velocity;  ///< rad/s, at present, or filtered if the unit has a bandwidth
  Vector3 specific_force;    ///< m/s^2, mean over the last advance() in the axes of each substep, or filtered
};

class WorldMeasurements : public WorldPart {
 public:
  using WorldPart::WorldPart;

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
  /// What an inertial measurement unit measures.
  Inertial sensor_motion(ObjectId sensor) const;
};

}  // namespace bubblesim
