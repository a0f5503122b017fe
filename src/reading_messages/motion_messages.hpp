// SPDX-License-Identifier: BSD-3-Clause
// Messages of poses, motions and joints.
#pragma once

#include <string>
#include <vector>

#include "bubblesim/world.hpp"
#include "parts.hpp"

namespace bubblesim::reading_messages {

/// The pose of a frame in that of the header, and its velocity.
struct OdometryReading {
  std::string child_frame;
  Pose pose;
  Twist velocity;
  Variances<6> pose_variances{};  ///< of x, y, z and of the rotations about them
  Variances<6> velocity_variances{};
};

/// nav_msgs/Odometry.
void odometry(Fields& fields, const Header& header, const OdometryReading& reading);

/// The states of the first axes of joints; rad, m, N m, N.
struct JointReadings {
  std::vector<std::string> names;
  std::vector<double> positions;
  std::vector<double> velocities;
  std::vector<double> efforts;  ///< of the motors, the mean over the step
};

JointReadings read_joints(const World& world, const std::vector<ObjectId>& joints);

/// sensor_msgs/JointState.
void joint_state(Fields& fields, const Header& header, const JointReadings& joints);

/// geometry_msgs/TransformStamped.
struct TransformReading {
  Header header;
  std::string child_frame;
  Pose pose;
};

/// tf2_msgs/TFMessage.
void transforms(Fields& fields, const std::vector<TransformReading>& readings);

}  // namespace bubblesim::reading_messages
