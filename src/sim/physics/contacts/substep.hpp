// SPDX-License-Identifier: BSD-3-Clause
// What a physics substep works on.
#pragma once

#include <vector>

#include "bubblesim/math.hpp"
#include "bubblesim/scene.hpp"
#include "bubblesim/world_devices.hpp"
#include "physics/contacts/contact_memory.hpp"
#include "physics/contacts/found_contacts.hpp"
#include "physics/contacts/islands.hpp"
#include "physics/contacts/near_shapes.hpp"
#include "physics/contacts/spaces.hpp"
#include "physics/ode/ode_world.hpp"
#include "physics/parts/hold.hpp"
#include "physics/parts/placed_model.hpp"

namespace bubblesim {

/// The contacts of a world in the last substep.
struct Contacts {
  FoundContacts found;
  Islands islands;               // of models, by their index among the moving ones
  ContactMemory memory;          // between models of which one is awake
  ContactMemory asleep;          // of models that sleep
  ContactMemory memory_before;   // working memory
  ContactFilter filter;          // may be empty
  std::vector<NearShapes> near;  // by index among the moving models
};

struct Substep {
  double duration;  // s
  const Vector3& gravity;
  MovingModels& moving;
  Spaces& spaces;
  OdeWorld& ode;
  Contacts& contacts;
  const Holds& holds;
  Solver solver = Solver::kBubblesim;  // of islands with joints
};

}  // namespace bubblesim
