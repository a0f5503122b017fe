// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/planar_force_drive.hpp"

#include <cmath>

#include "bubblesim/error.hpp"
#include "devices/link_bodies.hpp"
#include "devices/planar_limits.hpp"

namespace bubblesim {

PlanarForceDrive::PlanarForceDrive(const World& world, ObjectId link, const Gains& gains) : link_(link), gains_(gains) {
  check_pushable(world, link);
  for (const double gain : {gains.forward, gains.leftward, gains.turning}) {
    if (!(std::isfinite(gain) && gain >= 0)) throw InvalidInput("the gains must be finite and not negative");
  }
}

void PlanarForceDrive::set_velocity(double forward, double leftward, double turning) {
  check_planar_velocity(forward, leftward, turning);
  forward_ = forward;
  leftward_ = leftward;
  turning_ = turning;
}

void PlanarForceDrive::update(World& world, double, double duration) {
  weigh(world);
  const LinkMotion motion = motion_of(world, link_);
  const Twist others = other_acceleration(motion.twist);
  const double yaw = to_rpy(motion.pose.orientation).z();
  const Vector3 ahead(std::cos(yaw), std::sin(yaw), 0);
  const Vector3 aside(-ahead.y(), ahead.x(), 0);
  // The mean over the substep of the force gain * error(t), with m v' = gain * error + m a, where a is the others'. The
  // force of its beginning would overshoot with a large gain, and leave an error that depends on the substep.
  const auto push = [duration](double gain, double inertia, double error, double acceleration) {
    if (gain == 0) return 0.0;
    const double decay = mean_decay(gain / inertia, duration);
    return inertia * (decay * error + acceleration * (decay * inertia / gain - 1));
  };
  const auto along = [&](const Vector3& axis, double gain, double velocity) -> Vector3 {
    return axis * push(gain, mass_, velocity - axis.dot(motion.twist.linear), axis.dot(others.linear));
  };
  last_.duration = duration;
  last_.twist = motion.twist;
  last_.wrench.force = along(ahead, gains_.forward, forward_) + along(aside, gains_.leftward, leftward_);
  last_.wrench.torque.z() = push(gains_.turning, inertia_, turning_ - motion.twist.angular.z(), others.angular.z());
  world.wrenches().apply(link_, last_.wrench);
}

Twist PlanarForceDrive::other_acceleration(const Twist& now) const {
  Twist others;
  if (last_.duration == 0) return others;
  others.linear = (now.linear - last_.twist.linear) / last_.duration - last_.wrench.force / mass_;
  others.angular.z() =
      (now.angular.z() - last_.twist.angular.z()) / last_.duration - last_.wrench.torque.z() / inertia_;
  return others;
}

void PlanarForceDrive::weigh(const World& world) {
  if (revision_ == world.revision()) return;
  revision_ = world.revision();
  mass_ = inertia_ = 0;
  const Vector3 centre = motion_of(world, link_).centre;
  const ObjectId model = world.tree().outermost_model_of(link_);
  for (const ObjectId id : world.tree().parts(model, ObjectKind::kLink)) {
    const LinkDescription& link = link_description(world, id);
    const LinkMotion motion = motion_of(world, id);
    const Vector3 up = motion.pose.orientation.conjugate() * Vector3::UnitZ();
    const Vector3 away = motion.centre - centre;
    mass_ += link.mass;
    inertia_ += up.dot(link.inertia() * up) + link.mass * (away.x() * away.x() + away.y() * away.y());
  }
}

void PlanarForceDrive::reset(World&) {
  forward_ = leftward_ = turning_ = 0;
  last_ = {};
}

void PlanarForceDrive::transfer(StateArchive& archive) {
  archive(forward_, leftward_, turning_, last_.duration, last_.twist.linear, last_.twist.angular, last_.wrench.force,
          last_.wrench.torque);
}

}  // namespace bubblesim
