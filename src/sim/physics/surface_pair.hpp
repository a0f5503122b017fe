// SPDX-License-Identifier: BSD-3-Clause
// What two surfaces in touch make together, as Gazebo combines them.
#pragma once

#include <ode/ode.h>

#include "bubblesim/scene.hpp"

namespace bubblesim {

struct SurfacePair {
  dSurfaceParameters ode{};
  const Surface* directed = nullptr;  ///< the one whose fdir1 counts; null when none has a direction
  double sink = 0;                    ///< m that the shapes may sink into one another
  double sink_speed = 0;              ///< m/s at most at which they do, when the contact is rigid; 0: only by chance
  double max_depth = 0;               ///< m; a deeper overlap is treated as this one, or things would fly apart
};

/// For a substep of `step` seconds.
SurfacePair combine(const Surface& a, const Surface& b, double step);

}  // namespace bubblesim
