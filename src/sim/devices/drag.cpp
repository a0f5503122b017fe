// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/drag.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bubblesim/error.hpp"
#include "devices/link_bodies.hpp"
#include "scene/describe.hpp"
#include "validation/limits.hpp"

namespace bubblesim {
namespace {

/// For each axis: -(linear + quadratic |v|) v, but at most what stops the inertia within the time.
Vector3 resistance(const Vector3& velocity, const Vector3& linear, const Vector3& quadratic, const Vector3& inertia,
                   double duration) {
  const Vector3 slope = linear + quadratic.cwiseProduct(velocity.cwiseAbs());
  return -slope.cwiseMin(inertia / duration).cwiseProduct(velocity);
}

}  // namespace

Drag::Drag(const World& world, const DragDescription& description, std::shared_ptr<const Wind> wind)
    : description_(description), wind_(std::move(wind)) {
  check_pushable(world, description_.link);
  for (const Vector3& coefficients :
       {description_.linear, description_.quadratic, description_.angular_linear, description_.angular_quadratic}) {
    if (within(coefficients, kMaxEffort) && coefficients.minCoeff() >= 0) continue;
    throw InvalidInput(world.tree().short_path(description_.link) + ": the drag coefficients " + text(coefficients) +
                       " are not usable: each must be from 0 to 1e9");
  }
  if (description_.in_wind && wind_ == nullptr) throw InvalidInput("drag in the wind needs the wind");
}

void Drag::set_current(const Vector3& current) {
  if (!within(current, kMaxSpeed)) {
    throw InvalidInput("the current " + text(current) + " m/s is not usable: it must be finite and at most 1e6");
  }
  current_ = current;
}

void Drag::update(World& world, double, double duration) {
  const DragDescription& d = description_;
  const LinkDescription& link = link_description(world, d.link);
  const Pose pose = world.pose(d.link);
  const Twist twist = world.velocity(d.link);
  const Vector3 fluid = current_ + (d.in_wind ? wind_->velocity() : Vector3::Zero());
  const Vector3 velocity = pose.orientation.conjugate() * (twist.linear - fluid);
  const Vector3 turning = pose.orientation.conjugate() * twist.angular;
  const Vector3 force = resistance(velocity, d.linear, d.quadratic, Vector3::Constant(link.mass), duration);
  const Vector3 torque = resistance(turning, d.angular_linear, d.angular_quadratic, link.inertia_diagonal, duration);
  world.wrenches().apply(d.link, {pose.orientation * force, pose.orientation * torque}, pose.position);
}

void Drag::reset(World&) { current_ = Vector3::Zero(); }

void Drag::transfer(StateArchive& archive) { archive(current_); }

}  // namespace bubblesim
