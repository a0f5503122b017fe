// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/lift_drag.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "bubblesim/error.hpp"
#include "devices/link_bodies.hpp"
#include "scene/describe.hpp"
#include "validation/limits.hpp"

namespace bubblesim {
namespace {

constexpr double kSlowest = 0.01;  // m/s; no force below this speed, as in Gazebo

void check_wing(const World& world, const LiftDragDescription& d) {
  check_pushable(world, d.link);
  const std::string path = world.tree().short_path(d.link);
  const auto require = [&](bool fine, const char* what, const std::string& value, const char* wanted) {
    if (fine) return;
    throw InvalidInput(path + ": the " + what + " " + value + " of the wing is not usable: it must be " + wanted);
  };
  const auto finite = [&](const char* what, double value) {
    require(within(value, kMaxSpeed), what, text(value), "finite and at most 1e6");
  };
  require(d.area >= 0 && d.area <= kMaxSpeed, "area", text(d.area) + " m^2", "from 0 to 1e6 m^2");
  require(d.density >= 0 && d.density <= kMaxSpeed, "density", text(d.density) + " kg/m^3", "from 0 to 1e6 kg/m^3");
  require(d.alpha_stall >= 0 && d.alpha_stall <= M_PI, "stall angle", text(d.alpha_stall) + " rad", "from 0 to pi");
  require(within(d.centre_of_pressure, kMaxSize), "centre of pressure", text(d.centre_of_pressure) + " m", "finite");
  for (const auto& [name, value] :
       {std::pair("angle of attack", d.alpha0), std::pair("lift slope", d.lift_slope),
        std::pair("drag slope", d.drag_slope), std::pair("lift slope beyond the stall", d.lift_slope_stall),
        std::pair("drag slope beyond the stall", d.drag_slope_stall),
        std::pair("slope of the flap", d.control_slope)}) {
    finite(name, value);
  }
  const bool usable = within(d.forward, kMaxSpeed) && within(d.upward, kMaxSpeed) &&
                      d.forward.normalized().cross(d.upward.normalized()).norm() > 1e-6;
  require(usable, "forward and upward directions", text(d.forward) + ", " + text(d.upward), "not parallel");
  if (d.control_joint != kNoObject) world.joints().max_force(d.control_joint);  // throws when it has no axis
}

/// A coefficient that is proportional to the angle of attack up to the stall.
double coefficient(double alpha, double slope, double stall, double slope_beyond) {
  const double attached = std::clamp(alpha, -stall, stall);
  return slope * attached + slope_beyond * (alpha - attached);
}

/// Within +-pi/2: a wing that flies backwards is one that flies forwards.
double folded(double angle) {
  angle = std::remainder(angle, 2 * M_PI);
  return std::abs(angle) > M_PI / 2 ? angle - std::copysign(M_PI, angle) : angle;
}

}  // namespace

LiftDrag::LiftDrag(const World& world, const LiftDragDescription& description, std::shared_ptr<const Wind> wind)
    : description_(description), wind_(std::move(wind)) {
  check_wing(world, description_);
  description_.forward.normalize();
  description_.upward.normalize();
}

void LiftDrag::update(World& world, double, double) {
  const LiftDragDescription& d = description_;
  const Pose pose = world.pose(d.link);
  const Twist twist = world.velocity(d.link);
  const Vector3 offset = pose.orientation * d.centre_of_pressure;
  Vector3 velocity = twist.linear + twist.angular.cross(offset);
  if (wind_) velocity -= wind_->velocity();
  if (!(velocity.norm() > kSlowest)) return;

  const Vector3 forward = pose.orientation * d.forward;
  Vector3 upward = pose.orientation * d.upward;
  if (d.radial_symmetry) {
    upward = forward.cross(forward.cross(velocity));
    if (upward.norm() < 1e-6) return;  // the flow is along the axis of symmetry
    upward.normalize();
  }
  const Vector3 span = forward.cross(upward).normalized();
  const double sine_of_sweep = std::clamp(span.dot(velocity.normalized()), -1.0, 1.0);
  const double sweep_factor = 1 - sine_of_sweep * sine_of_sweep;
  const Vector3 in_plane = velocity - span * velocity.dot(span);
  const double speed = in_plane.norm();
  if (!(speed > 0)) return;
  const Vector3 lift_direction = span.cross(in_plane) / speed;

  // The lift is across the flow: it leans forward by the angle of attack.
  const double lean = std::atan2(lift_direction.cross(upward).norm(), lift_direction.dot(upward));
  const double alpha = folded(d.alpha0 + (lift_direction.dot(forward) >= 0 ? lean : -lean));
  double lift = coefficient(alpha, d.lift_slope, d.alpha_stall, d.lift_slope_stall) * sweep_factor;
  if (std::abs(alpha) > d.alpha_stall) lift = alpha > 0 ? std::max(lift, 0.0) : std::min(lift, 0.0);
  if (d.control_joint != kNoObject) lift += d.control_slope * world.joints().position(d.control_joint);
  const double drag = std::abs(coefficient(alpha, d.drag_slope, d.alpha_stall, d.drag_slope_stall) * sweep_factor);

  const double pressure = 0.5 * d.density * speed * speed;
  const Vector3 force = (lift_direction * lift - in_plane / speed * drag) * (pressure * d.area);
  world.wrenches().apply(d.link, {force, {}}, pose.position + offset);
}

}  // namespace bubblesim
