// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/wheel_slip.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "bubblesim/error.hpp"
#include "bubblesim/state_archive.hpp"
#include "scene/describe.hpp"
#include "validation/limits.hpp"

namespace bubblesim {
namespace {

constexpr double kMostCompliance = 1e6;

void check(double value, bool may_be_zero, double most, const std::string& what) {
  if ((may_be_zero ? value >= 0 : value > 0) && value <= most) return;
  throw InvalidInput(what + " " + text(value) + " is not usable: it must be " +
                     (may_be_zero ? "0 or more" : "more than 0") + ", and at most " + text(most));
}

void check_compliance(double compliance) { check(compliance, true, kMostCompliance, "the slip compliance"); }

/// The direction of the joint's axis in its child.
Vector3 axis_in_child(const World& world, ObjectId joint) {
  const Vector3& direction = world.joints().description(joint).axes.front().direction;
  const Quaternion in_world = world.joints().child_pose(joint).orientation;
  return world.pose(world.joints().links(joint).second).orientation.conjugate() * (in_world * direction);
}

}  // namespace

WheelSlip::WheelSlip(const World& world, std::vector<SlippingWheel> wheels) : wheels_(std::move(wheels)) {
  for (const SlippingWheel& wheel : wheels_) {
    const std::string path = world.tree().short_path(wheel.joint);
    const std::string type = world.joints().description(wheel.joint).type;
    if (world.joints().axes(wheel.joint) != 1 || (type != "revolute" && type != "continuous")) {
      throw WrongObject(path + " does not turn about one axis, as that of a wheel does");
    }
    const ObjectId link = world.joints().links(wheel.joint).second;
    world.properties().friction(link);  // throws without collisions
    check(wheel.radius, false, kMaxSize, path + ": the radius");
    check(wheel.normal_force, false, kMaxEffort, path + ": the normal force");
    check_compliance(wheel.compliance.lateral);
    check_compliance(wheel.compliance.longitudinal);
    axes_.push_back(axis_in_child(world, wheel.joint));
    present_.push_back(wheel.compliance);
  }
}

void WheelSlip::set_compliance(std::optional<double> lateral, std::optional<double> longitudinal) {
  if (lateral) check_compliance(*lateral);
  if (longitudinal) check_compliance(*longitudinal);
  for (SlipCompliance& present : present_) {
    if (lateral) present.lateral = *lateral;
    if (longitudinal) present.longitudinal = *longitudinal;
  }
}

Vector3 WheelSlip::slip(const World& world, std::size_t wheel) const {
  const SlippingWheel& of = wheels_.at(wheel);
  const ObjectId link = world.joints().links(of.joint).second;
  const Vector3 axis = world.pose(link).orientation * axes_[wheel];
  const Vector3 ahead = world.properties().gravity().cross(axis);
  const double length = ahead.norm();
  const Vector3 velocity = world.velocity(link).linear;
  const double spin = of.radius * world.joints().velocity(of.joint);
  return {(length > 0 ? ahead.dot(velocity) / length : 0) - spin, axis.dot(velocity), spin};
}

void WheelSlip::update(World& world, double /*time*/, double /*duration*/) {
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    const SlippingWheel& wheel = wheels_[i];
    const double per_force = wheel.radius * std::abs(world.joints().velocity(wheel.joint)) / wheel.normal_force;
    world.properties().set_slip(world.joints().links(wheel.joint).second, axes_[i], per_force * present_[i].lateral,
                                per_force * present_[i].longitudinal);
  }
}

void WheelSlip::reset(World& /*world*/) {
  for (std::size_t i = 0; i < wheels_.size(); ++i) present_[i] = wheels_[i].compliance;
}

void WheelSlip::transfer(StateArchive& archive) {
  for (SlipCompliance& present : present_) archive(present.lateral, present.longitudinal);
}

}  // namespace bubblesim
