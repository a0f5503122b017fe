// SPDX-License-Identifier: BSD-3-Clause
// ODE's spaces: where collisions are searched.
#pragma once

#include <cstdint>

#include "physics/ode/ode_handles.hpp"

namespace bubblesim {

struct Spaces {
  ode::SpaceHandle movers;    // one space per moving model that is awake
  ode::SpaceHandle sleepers;  // likewise of those that sleep; null without models that may
  ode::SpaceHandle statics;   // geoms without a body, of finite size
  ode::SpaceHandle planes;    // infinite geoms would degrade the quadtree of the statics
  /// Counts what a search among sleepers and statics may find otherwise than before: those that came, went or moved.
  std::uint64_t changes = 1;
};

}  // namespace bubblesim
