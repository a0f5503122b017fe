// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/control/joint_spline.hpp"

#include <algorithm>

namespace bubblesim::control {

JointSegment::JointSegment(const JointKnot& start, const JointKnot& end)
    : start_(start.time), duration_(end.time - start.time) {
  std::array<double, 6>& c = coefficients_;
  const double t = duration_;
  const double p0 = start.position;
  const double p1 = end.position;
  if (!(t > 0)) {  // a jump to the end
    c[0] = p1;
    return;
  }
  c[0] = p0;
  if (!start.velocity || !end.velocity) {
    c[1] = (p1 - p0) / t;
    return;
  }
  const double v0 = *start.velocity;
  const double v1 = *end.velocity;
  c[1] = v0;
  if (!start.acceleration || !end.acceleration) {
    c[2] = (3 * (p1 - p0) / t - 2 * v0 - v1) / t;
    c[3] = (-2 * (p1 - p0) / t + v0 + v1) / (t * t);
    return;
  }
  const double a0 = *start.acceleration;
  const double a1 = *end.acceleration;
  const double t2 = t * t;
  c[2] = a0 / 2;
  c[3] = (20 * (p1 - p0) - (8 * v1 + 12 * v0) * t - (3 * a0 - a1) * t2) / (2 * t2 * t);
  c[4] = (-30 * (p1 - p0) + (14 * v1 + 16 * v0) * t + (3 * a0 - 2 * a1) * t2) / (2 * t2 * t2);
  c[5] = (12 * (p1 - p0) - 6 * (v1 + v0) * t - (a0 - a1) * t2) / (2 * t2 * t2 * t);
}

JointState JointSegment::at(double time) const {
  const std::array<double, 6>& c = coefficients_;
  const double t = std::clamp(time - start_, 0.0, duration_);
  JointState state;
  state.position = c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * (c[4] + t * c[5]))));
  if (time < start_ || time > end()) return state;
  state.velocity = c[1] + t * (2 * c[2] + t * (3 * c[3] + t * (4 * c[4] + t * 5 * c[5])));
  state.acceleration = 2 * c[2] + t * (6 * c[3] + t * (12 * c[4] + t * 20 * c[5]));
  return state;
}

void JointSegment::transfer(StateArchive& archive) {
  archive(start_, duration_);
  for (double& coefficient : coefficients_) archive(coefficient);
}

}  // namespace bubblesim::control
