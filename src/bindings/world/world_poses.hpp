// SPDX-License-Identifier: BSD-3-Clause
// Poses as lists of seven numbers, and the frames of objects that poses are relative to.
#pragma once

#include <array>

#include "bubblesim/world.hpp"

namespace bubblesim::bindings {

using Pose7 = std::array<double, 7>;  // x, y, z, then qx, qy, qz, qw

inline Pose7 to_list(const Pose& pose) {
  return {pose.position.x(),    pose.position.y(),    pose.position.z(),   pose.orientation.x(),
          pose.orientation.y(), pose.orientation.z(), pose.orientation.w()};
}

inline Pose to_pose(const Pose7& p) { return {Vector3(p[0], p[1], p[2]), Quaternion(p[6], p[3], p[4], p[5])}; }

/// The frame for poses relative to an object; for a joint, its moving frame.
inline Pose frame_of(const World& world, ObjectId object) {
  const bool is_joint = world.tree().at(object).kind == ObjectKind::kJoint || world.joints().is_kinematic(object);
  return is_joint ? world.joints().child_pose(object) : world.pose(object);
}

}  // namespace bubblesim::bindings
