// SPDX-License-Identifier: BSD-3-Clause
#include "physics/convex/swept.hpp"

#include <algorithm>
#include <cmath>

#include "physics/convex/gjk.hpp"

namespace bubblesim {
namespace {

constexpr int kMaxAdvances = 64;
constexpr double kOverlap = 1e-4;  // of the first shape's reach, at the meeting

Vec3 rotated(const Vec3& v, const Vec3& axis, double angle) {
  return v * std::cos(angle) + cross(axis, v) * std::sin(angle) + axis * (dot(axis, v) * (1 - std::cos(angle)));
}

/// Axis and angle of a rotation: the antisymmetric part of its matrix is the axis times the sine.
void find_turn(const Transform& r, Vec3& axis, double& angle) {
  const Vec3 twice_sine{r.y.z - r.z.y, r.z.x - r.x.z, r.x.y - r.y.x};
  const double sine = length(twice_sine) / 2;
  const double cosine = (r.x.x + r.y.y + r.z.z - 1) / 2;
  if (sine < 1e-12) return;  // also half a turn, of which the axis is not known: taken as none
  axis = unit(twice_sine);
  angle = std::atan2(sine, cosine);
}

double surface_reach(const MovingShape& moving) {
  const ConvexShape& shape = moving.shape;
  return length(shape.centre() - moving.motion.centre()) + shape.reach() - shape.rounding();
}

}  // namespace

RigidMotion::RigidMotion(const Transform& start, const Transform& end) : end_(end), travel_(end.origin - start.origin) {
  find_turn(end * inverse(start), axis_, angle_);
}

Transform RigidMotion::back_to(double fraction) const {
  const double back = -angle_ * (1 - fraction);
  Transform result;
  result.x = rotated({1, 0, 0}, axis_, back);
  result.y = rotated({0, 1, 0}, axis_, back);
  result.z = rotated({0, 0, 1}, axis_, back);
  result.origin = end_.origin - travel_ * (1 - fraction) - result.turn(end_.origin);
  return result;
}

std::optional<double> meeting(const MovingShape& a, const MovingShape& b) {
  ConvexShape moved_a = a.shape;
  ConvexShape moved_b = b.shape;
  const double rounding = moved_a.rounding() + moved_b.rounding();
  const double overlap = kOverlap * moved_a.reach();
  const double spin = a.motion.angle() * surface_reach(a) + b.motion.angle() * surface_reach(b);
  double fraction = 0;
  for (int i = 0; i < kMaxAdvances; ++i) {
    moved_a.set_frame(a.motion.back_to(fraction) * a.shape.frame());
    moved_b.set_frame(b.motion.back_to(fraction) * b.shape.frame());
    const CoreDistance cores = core_distance(moved_a, moved_b);
    const double gap = cores.overlap ? -1 : cores.distance - rounding;
    if (gap <= 0) {
      if (i == 0) return {};
      return fraction;
    }
    const Vec3 normal = unit(cores.on_a - cores.on_b);
    const double approach = dot(b.motion.travel() - a.motion.travel(), normal) + spin;
    if (approach <= 0) return {};
    fraction += (gap + overlap) / approach;
    if (fraction >= 1) return {};
  }
  return fraction;
}

}  // namespace bubblesim
