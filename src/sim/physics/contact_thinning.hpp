// SPDX-License-Identifier: BSD-3-Clause
// Which of the points in which two links touch are enough to hold them.
#pragma once

#include <ode/ode.h>

#include <vector>

#include "physics/islands.hpp"

namespace bubblesim {

struct Collider;

/// A point in which two shapes touch, before it is one of ODE's joints.
struct FoundContact {
  const Collider* first = nullptr;
  const Collider* second = nullptr;
  dContact contact{};
};

/// Wheels of several shapes and meshes touch the ground in more points than hold them. In each island with more
/// contacts than the exact solver takes, and only where this leaves few enough, keeps of those that two links have on
/// one plane with one kind of surface the four that lie farthest apart. The order stays.
void thin_out(std::vector<FoundContact>& found, Islands& islands);

}  // namespace bubblesim
