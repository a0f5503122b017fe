// SPDX-License-Identifier: BSD-3-Clause
// Limits of a commanded velocity, its change and the change of its change, as in ros_controllers.
#pragma once

#include <optional>

namespace bubblesim::control {

struct SpeedLimits {
  struct Range {
    double min = 0;
    double max = 0;
  };
  std::optional<Range> velocity;      ///< m/s or rad/s
  std::optional<Range> acceleration;  ///< per s
  std::optional<Range> jerk;          ///< per s^2

  /// The velocity nearest to `wanted`. `last` and `second_last` are those of the last two calls, `period` the time in s
  /// between calls. Jerk, then acceleration, then velocity is limited.
  double limit(double wanted, double last, double second_last, double period) const;
};

}  // namespace bubblesim::control
