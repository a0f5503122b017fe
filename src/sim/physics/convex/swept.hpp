// SPDX-License-Identifier: BSD-3-Clause
// The time at which two moving convex shapes meet, by conservative advancement (Mirtich 1996).
#pragma once

#include <optional>

#include "physics/convex/convex_shape.hpp"

namespace bubblesim {

/// The motion of a body during a substep: it moves straight, and turns about one axis.
class SweptMotion {
 public:
  SweptMotion(const Transform& start, const Transform& end);
  /// A body that does not move.
  SweptMotion() = default;

  /// From its pose at the end to that at a fraction of the motion, in the world.
  Transform back_to(double fraction) const;
  Transform at(double fraction) const { return back_to(fraction) * end_; }

  const Vector3& travel() const { return travel_; }
  double angle() const { return turn_.angle(); }  // rad
  const Vector3& centre() const { return end_.position; }

 private:
  Transform end_;
  Vector3 travel_;  // m
  Eigen::AngleAxisd turn_ = Eigen::AngleAxisd::Identity();
};

/// A shape at the end of the motion of its body.
struct MovingShape {
  const ConvexShape& shape;
  const SweptMotion& motion;
};

/// The fraction of the motion after which the shapes overlap slightly for the first time; empty when they do not meet,
/// or overlap from the start.
std::optional<double> meeting(const MovingShape& a, const MovingShape& b);

}  // namespace bubblesim
