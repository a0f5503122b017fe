// SPDX-License-Identifier: BSD-3-Clause
#include "physics/convex/swept.hpp"

#include <algorithm>
#include <cmath>

#include "physics/convex/gjk.hpp"

namespace bubblesim {
namespace {

constexpr int kMaxAdvances = 64;
constexpr double kOverlap = 1e-4;  // of the first shape's reach, at the meeting

double surface_reach(const MovingShape& moving) {
  const ConvexShape& shape = moving.shape;
  return (shape.centre() - moving.motion.centre()).norm() + shape.reach() - shape.rounding();
}

/// The length of the path of a shape's centre as it turns with its body.
double turned_way(const MovingShape& moving) {
  return moving.motion.angle() * (moving.shape.centre() - moving.motion.centre()).norm();
}

/// Whether the shapes stay apart in the whole motion, by the balls around them.
bool are_apart(const MovingShape& a, const MovingShape& b) {
  const double way = (b.motion.travel() - a.motion.travel()).norm() + turned_way(a) + turned_way(b);
  const double reach = a.shape.reach() + b.shape.reach() + way;
  return (a.shape.centre() - b.shape.centre()).squaredNorm() > reach * reach;
}

}  // namespace

SweptMotion::SweptMotion(const Transform& start, const Transform& end)
    : end_(end), travel_(end.position - start.position), turn_(end.rotation * start.rotation.transpose()) {}

Transform SweptMotion::back_to(double fraction) const {
  const double left = 1 - fraction;
  const Matrix3 rotation = Eigen::AngleAxisd(-turn_.angle() * left, turn_.axis()).toRotationMatrix();
  return {end_.position - travel_ * left - rotation * end_.position, rotation};
}

std::optional<double> meeting(const MovingShape& a, const MovingShape& b) {
  if (are_apart(a, b)) return {};
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
    const Vector3 normal = (cores.on_a - cores.on_b).normalized();
    const double approach = (b.motion.travel() - a.motion.travel()).dot(normal) + spin;
    if (approach <= 0) return {};
    fraction += (gap + overlap) / approach;
    if (fraction >= 1) return {};
  }
  return fraction;
}

}  // namespace bubblesim
