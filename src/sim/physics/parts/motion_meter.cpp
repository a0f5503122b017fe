// SPDX-License-Identifier: BSD-3-Clause
#include "physics/parts/motion_meter.hpp"

#include "physics/ode/ode_math.hpp"

namespace bubblesim {

void MotionMeter::clear() {
  specific_force_.clear();
  angular_velocity_.clear();
}

void MotionMeter::begin() {
  const Pose pose = body_pose(body_);
  orientation_ = pose.orientation * in_body_.orientation;
  lever_ = pose.orientation * in_body_.position;
  before_ = body_velocity(body_);
}

void MotionMeter::end(double step, const Vector3& gravity, ForcePlace place) {
  if (place == ForcePlace::kOnTheWay) {
    const Quaternion after = body_pose(body_).orientation;
    const Quaternion before = orientation_ * in_body_.orientation.conjugate();
    const Quaternion middle = before.slerp(0.5, after);
    orientation_ = middle * in_body_.orientation;
    lever_ = middle * in_body_.position;
  }
  // Acceleration of a point of a rigid body: that of its centre of mass, the Euler and the centripetal acceleration.
  const Twist after = body_velocity(body_);
  const Vector3 angular = (after.angular - before_.angular) / step;
  const Vector3 turning = (after.angular + before_.angular) / 2;
  const Vector3 acceleration =
      (after.linear - before_.linear) / step + angular.cross(lever_) + turning.cross(turning.cross(lever_));
  specific_force_.add(orientation_.conjugate() * (acceleration - gravity), step);
  if (bandwidth_ > 0) angular_velocity_.add(orientation_.conjugate() * turning, step);
}

Vector3 MotionMeter::angular_velocity() const {
  if (angular_velocity_.has_value()) return angular_velocity_.value();
  const Pose pose = body_pose(body_);
  return (pose.orientation * in_body_.orientation).conjugate() * body_velocity(body_).angular;
}

}  // namespace bubblesim
