// SPDX-License-Identifier: BSD-3-Clause
// Reduces the contacts of two links to those that hold them.
#pragma once

#include <ode/ode.h>

#include <vector>

#include "physics/islands.hpp"

namespace bubblesim {

struct Collider;

/// A contact point of two shapes, before it becomes an ODE joint.
struct FoundContact {
  const Collider* first = nullptr;
  const Collider* second = nullptr;
  dContact contact{};
};

/// Wheels with several shapes, and meshes, touch the ground in more points than necessary. In each contact island with
/// more contacts than the exact solver takes, and only if the result is few enough, keeps four of the contacts of two
/// links on one plane with equal surface parameters: those that are farthest apart. The order is kept.
void thin_out(std::vector<FoundContact>& found, Islands& islands);

}  // namespace bubblesim
