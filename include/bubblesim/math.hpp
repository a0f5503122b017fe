// SPDX-License-Identifier: BSD-3-Clause
// Vectors, quaternions and poses. SI units, x forward, z up (REP 103).
#pragma once

#include <ignition/math/Pose3.hh>
#include <ignition/math/Quaternion.hh>
#include <ignition/math/Vector3.hh>

namespace bubblesim {

using Vector3 = ignition::math::Vector3d;
using Quaternion = ignition::math::Quaterniond;  ///< constructed as (w, x, y, z); shown to users as x, y, z, w
using Pose = ignition::math::Pose3d;             ///< `a * b`: b given in the frame of a

struct Twist {
  Vector3 linear;   ///< m/s, world axes
  Vector3 angular;  ///< rad/s, world axes
};

}  // namespace bubblesim
