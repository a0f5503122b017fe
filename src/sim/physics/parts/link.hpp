// SPDX-License-Identifier: BSD-3-Clause
// A link in ODE.
#pragma once

#include "bubblesim/math.hpp"
#include "bubblesim/scene.hpp"
#include "bubblesim/scene_tree.hpp"
#include "physics/ode/ode_handles.hpp"
#include "scene/transform.hpp"

namespace bubblesim {

/// The motion of a link in a substep, and the sizes that decide whether it is fast.
struct Sweep {
  double half_size = kNoSize;  // m, half the smallest size of its shapes
  double spin_reach = 0;       // m, by which turning by one radian moves its surface at most
  Transform start;             // of its body, at the start of the substep

  static constexpr double kNoSize = 1e300;  // of a link that is not tested
};

/// Static links have no body and stay at `pose`, or move with another link.
struct Link {
  ode::BodyHandle body;
  double mass = 0;               // kg, at present; 0 without a body
  Vector3 centre_of_mass;        // body's origin, in the link's frame
  Pose pose;                     // of static links, in the world
  ObjectId carrier = kNoObject;  // of a static link: with which it moves
  Pose in_carrier;
  ObjectId object = kNoObject;
  int number = 0;  // among the links of moving models
  Pose rest_pose;  // of the body, where it came to rest last
  Twist before;    // of the body, at the start of the last advance()
  Sweep sweep;
};

/// Pose in the world.
Pose link_pose(const Link& link);

/// Sets the mass of a body, kg, with the moments of inertia of the description scaled to it.
void set_inertia(dBodyID body, const LinkDescription& link, double mass);

}  // namespace bubblesim
