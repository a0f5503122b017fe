// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/Transform.h>
#include <tf2/LinearMath/Quaternion.h>
#include <tf2/LinearMath/Transform.h>

namespace bubblesim {

inline tf2::Transform to_tf2(const geometry_msgs::Transform& transform) {
  const geometry_msgs::Quaternion& rotation = transform.rotation;
  const geometry_msgs::Vector3& translation = transform.translation;
  return tf2::Transform(tf2::Quaternion(rotation.x, rotation.y, rotation.z, rotation.w),
                        tf2::Vector3(translation.x, translation.y, translation.z));
}

}  // namespace bubblesim
