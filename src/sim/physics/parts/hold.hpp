// SPDX-License-Identifier: BSD-3-Clause
// Two links that are held to each other while the simulation runs, as by a fixed joint.
#pragma once

#include <vector>

#include "bubblesim/math.hpp"
#include "bubblesim/world_attachments.hpp"
#include "physics/ode/ode_handles.hpp"
#include "physics/parts/placed_model.hpp"

namespace bubblesim {

/// Solved as rows between the trees of both models, or by a joint of ODE's for a substep in which ODE solves the
/// island: its place among the joints, and so the bits of the solution, depend on the state alone.
struct Hold {
  Attachment attachment;
  const PlacedModel* model = nullptr;  // of the link that is held, which moves
  const Link* link = nullptr;
  const PlacedModel* holder_model = nullptr;  // null: the world
  const Link* holder = nullptr;
  Pose in_holder;  // of the link: in the holder, or in the world
};

using Holds = std::vector<Hold>;  // in the order in which they were made

/// Adds ODE's joint to a group.
void join(dWorldID world, dJointGroupID group, const Hold& hold);

/// Whether two links are held to each other.
bool are_held(const Holds& holds, const Link& a, const Link& b);

/// Where the held link is to be.
inline Pose held_pose(const Hold& hold) {
  return hold.holder == nullptr ? hold.in_holder : link_pose(*hold.holder) * hold.in_holder;
}

}  // namespace bubblesim
