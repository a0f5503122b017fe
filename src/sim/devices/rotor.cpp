// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/rotor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "bubblesim/error.hpp"
#include "devices/link_bodies.hpp"
#include "scene/describe.hpp"
#include "scene/joint_kind.hpp"
#include "validation/limits.hpp"

namespace bubblesim {
namespace {

constexpr double kStill = 1e-3;  // rad/s; a rotor below this speed does not keep the model awake

void check_rotor(const World& world, const RotorDescription& d) {
  const std::string path = world.tree().short_path(d.joint);
  const std::string& type = world.joints().description(d.joint).type;
  if (!find_joint_kind(type)->is_hinge) {
    throw WrongObject(path + " is a " + type + " joint: a rotor needs a revolute or continuous one");
  }
  check_pushable(world, world.joints().links(d.joint).second);
  const auto require = [&](bool fine, const char* what, double value, const char* wanted) {
    if (fine) return;
    throw InvalidInput(path + ": the " + what + " " + text(value) + " of the rotor is not usable: it must be " +
                       wanted);
  };
  const auto positive = [](double value) { return value > 0 && value <= kMaxSpeed; };
  const auto not_negative = [](double value) { return value >= 0 && value <= kMaxSpeed; };
  require(not_negative(d.thrust_coefficient), "thrust coefficient", d.thrust_coefficient, "from 0 to 1e6 N s^2");
  require(within(d.torque_length, kMaxSpeed), "length of the torque", d.torque_length, "finite and at most 1e6 m");
  require(not_negative(d.drag_coefficient), "drag coefficient", d.drag_coefficient, "from 0 to 1e6 kg");
  require(not_negative(d.rolling_coefficient), "rolling coefficient", d.rolling_coefficient, "from 0 to 1e6 kg m");
  require(positive(d.max_speed), "greatest speed", d.max_speed, "above 0 and at most 1e6 rad/s");
  require(not_negative(d.time_up), "time constant", d.time_up, "from 0 to 1e6 s");
  require(not_negative(d.time_down), "time constant", d.time_down, "from 0 to 1e6 s");
  require(d.slowdown >= 1 && d.slowdown <= kMaxSpeed, "slowdown", d.slowdown, "from 1 to 1e6");
}

/// Before its update, the device and the joint have the same target.
void turn_by_velocity(World& world, ObjectId joint) {
  world.joints().set_motor_mode(joint, MotorMode::kVelocity);
  world.joints().set_max_force(joint, std::numeric_limits<double>::infinity());
  world.joints().set_target_velocity(joint, 0);
}

}  // namespace

Rotor::Rotor(World& world, const RotorDescription& description, std::shared_ptr<const Wind> wind)
    : description_(description), wind_(std::move(wind)) {
  check_rotor(world, description_);
  turn_by_velocity(world, description_.joint);
}

void Rotor::set_speed(double speed) {
  if (!std::isfinite(speed)) {
    throw InvalidInput("the rotor speed " + text(speed) + " rad/s is not usable: it must be finite");
  }
  wanted_ = std::clamp(speed, -description_.max_speed, description_.max_speed);
}

void Rotor::take_command_of_joint(const World& world) {
  const double target = world.joints().target_velocity(description_.joint);
  if (target == target_) return;
  set_speed((description_.clockwise ? -target : target) * description_.slowdown);
}

void Rotor::push(World& world) const {
  const RotorDescription& d = description_;
  const double joint_speed = world.joints().velocity(d.joint) * d.slowdown;
  if (!(std::abs(joint_speed) > kStill)) return;
  const auto [airframe, propeller] = world.joints().links(d.joint);
  const Vector3 axis =
      world.joints().child_pose(d.joint).orientation * world.joints().description(d.joint).axes.front().direction;
  const double turning = d.clockwise ? -1 : 1;
  const double speed = std::abs(joint_speed);
  const double thrust = turning * joint_speed * speed * d.thrust_coefficient;
  Vector3 across = motion_of(world, propeller).twist.linear - (wind_ ? wind_->velocity() : Vector3::Zero());
  across -= axis * across.dot(axis);
  world.wrenches().apply(propeller, {axis * thrust - across * (speed * d.drag_coefficient), {}});
  if (airframe == kNoObject) return;
  const Vector3 torque = axis * (-turning * thrust * d.torque_length) - across * (speed * d.rolling_coefficient);
  world.wrenches().apply(airframe, {{}, torque});
}

void Rotor::update(World& world, double, double duration) {
  take_command_of_joint(world);
  push(world);
  const double time = std::abs(wanted_) > std::abs(speed_) ? description_.time_up : description_.time_down;
  speed_ += (wanted_ - speed_) * (time > 0 ? -std::expm1(-duration / time) : 1.0);
  if (std::abs(wanted_ - speed_) < kStill) speed_ = wanted_;
  const double target = (description_.clockwise ? -speed_ : speed_) / description_.slowdown;
  if (target != target_) world.joints().set_target_velocity(description_.joint, target);
  target_ = target;
}

void Rotor::reset(World& world) {
  wanted_ = speed_ = target_ = 0;
  turn_by_velocity(world, description_.joint);
}

void Rotor::transfer(StateArchive& archive) { archive(wanted_, speed_, target_); }

}  // namespace bubblesim
