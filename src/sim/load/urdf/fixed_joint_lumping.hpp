// SPDX-License-Identifier: BSD-3-Clause
// Makes one body of links that fixed joints join, as Gazebo does: URDF has many links that only name a place.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "load/load_context.hpp"
#include "load/urdf/urdf_robot.hpp"

namespace bubblesim {

/// A link of the file, in the body that it is a part of.
struct LumpedPart {
  const UrdfLink* link = nullptr;
  Pose pose;                         ///< in the frame of the body
  const UrdfJoint* joint = nullptr;  ///< the fixed joint that is lumped; null for the first part
};

/// A link of the model: a link of the file with all that is fixed to it.
struct LumpedLink {
  std::vector<LumpedPart> parts;     ///< first the link that it is named after
  Pose pose;                         ///< in the model's frame
  UrdfInertial inertial;             ///< of all parts, in the frame of the body
  const UrdfJoint* joint = nullptr;  ///< that holds it; null when it is free
  std::string parent;                ///< the link of the model at the other end of the joint, or the world
  bool is_held = false;              ///< a root without mass, which is fixed to the world

  const UrdfLink& link() const { return *parts.front().link; }
};

/// The links of the model, each after its parent, as Gazebo orders them: those at the joints of one link in the order
/// of the joints' names. The joints in `kept` are not lumped, unless one of their links has no mass. Links without mass
/// that would move are left out with all below them, with a warning; a root without mass is fixed to the world.
std::vector<LumpedLink> lump_fixed_joints(const UrdfRobot& robot, const std::set<std::string>& kept,
                                          LoadContext& context);

}  // namespace bubblesim
