// SPDX-License-Identifier: BSD-3-Clause
// Fast bodies do not pass through others within a substep: a model stops where one of its links first touches another
// body, with its velocity, and the contact acts in the next substep.
#pragma once

#include "bubblesim/world.hpp"
#include "physics/convex/swept.hpp"

namespace bubblesim {

struct Collider;

/// The motion of a link in a substep, and the sizes that decide whether it is fast.
struct Sweep {
  double half_size = kNoSize;  // m, half the smallest size of its shapes
  double spin_reach = 0;       // m, by which turning by one radian moves its surface at most
  Transform start;             // of its body, at the start of the substep

  static constexpr double kNoSize = 1e300;  // of a link that is not tested
};

/// Includes a shape of a link in its sizes. A mesh that collides as triangles is not tested.
void measure(const Collider& collider, Sweep& sweep);

/// Call before and after the step of the solver. Links are tested that moved by more than half their smallest size.
void note_motion(World::State& state);
void stop_at_impacts(World::State& state, double step);

}  // namespace bubblesim
