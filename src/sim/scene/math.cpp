// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/math.hpp"

#include <cmath>

namespace bubblesim {

Quaternion from_rpy(double roll, double pitch, double yaw) {
  return Eigen::AngleAxisd(yaw, Vector3::UnitZ()) * Eigen::AngleAxisd(pitch, Vector3::UnitY()) *
         Eigen::AngleAxisd(roll, Vector3::UnitX());
}

Vector3 to_rpy(const Quaternion& rotation) {
  // Bernardes & Viollet, "Quaternion to Euler angles conversion", PLOS ONE 17(11), 2022: the components' sums and
  // differences are (cos pitch/2 + sin pitch/2) times sine and cosine of (yaw - roll) / 2, and (cos pitch/2 -
  // sin pitch/2) times those of (yaw + roll) / 2. Unlike the arcsine of a matrix's element, that is exact near the
  // poles.
  constexpr double kPole = 1e-12;  // below, rounding determines an angle
  const Quaternion& q = rotation;
  const double plus = std::hypot(q.w() + q.y(), q.z() - q.x());
  const double minus = std::hypot(q.w() - q.y(), q.z() + q.x());
  double half_difference = std::atan2(q.z() - q.x(), q.w() + q.y());
  double half_sum = std::atan2(q.z() + q.x(), q.w() - q.y());
  if (minus < kPole) half_sum = half_difference;
  if (plus < kPole) half_difference = half_sum;
  return {std::remainder(half_sum - half_difference, 2 * M_PI), M_PI / 2 - 2 * std::atan2(minus, plus),
          std::remainder(half_sum + half_difference, 2 * M_PI)};
}

Quaternion turn_from_z(const Vector3& direction) {
  const Vector3 to = direction.normalized();
  if (to.z() < -1 + 1e-12) return {0, 1, 0, 0};
  // Half of the angle between them, about the cross product of both.
  const double twice_cosine = std::sqrt((1 + to.z()) * 2);
  return Quaternion(twice_cosine / 2, -to.y() / twice_cosine, to.x() / twice_cosine, 0).normalized();
}

}  // namespace bubblesim
