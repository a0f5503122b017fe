// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/control/speed_limiter.hpp"

#include <algorithm>

namespace bubblesim::control {

double SpeedLimits::limit(double wanted, double last, double second_last, double period) const {
  double velocity_now = wanted;
  if (jerk) {
    const double change = last - second_last;
    const double squared = 2 * period * period;  // as in ros_controllers: half the change of the acceleration
    const double more = std::clamp(velocity_now - last - change, jerk->min * squared, jerk->max * squared);
    velocity_now = last + change + more;
  }
  if (acceleration) {
    velocity_now = last + std::clamp(velocity_now - last, acceleration->min * period, acceleration->max * period);
  }
  return velocity ? std::clamp(velocity_now, velocity->min, velocity->max) : velocity_now;
}

}  // namespace bubblesim::control
