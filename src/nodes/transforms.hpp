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

inline geometry_msgs::Transform to_message(const tf2::Transform& transform) {
  geometry_msgs::Transform message;
  message.translation.x = transform.getOrigin().x();
  message.translation.y = transform.getOrigin().y();
  message.translation.z = transform.getOrigin().z();
  const tf2::Quaternion rotation = transform.getRotation();
  message.rotation.x = rotation.x();
  message.rotation.y = rotation.y();
  message.rotation.z = rotation.z();
  message.rotation.w = rotation.w();
  return message;
}

}  // namespace bubblesim
