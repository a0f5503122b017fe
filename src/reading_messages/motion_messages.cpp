// SPDX-License-Identifier: BSD-3-Clause
#include "motion_messages.hpp"

namespace bubblesim::reading_messages {

void odometry(Fields& fields, const Header& header, const OdometryReading& reading) {
  put(fields, header);
  fields.put("child_frame_id", std::string_view(reading.child_frame));
  fields.message("pose", [&] {
    put(fields, "pose", reading.pose);
    put(fields, "covariance", reading.pose_variances);
  });
  fields.message("twist", [&] {
    fields.message("twist", [&] {
      put(fields, "linear", reading.velocity.linear);
      put(fields, "angular", reading.velocity.angular);
    });
    put(fields, "covariance", reading.velocity_variances);
  });
}

JointReadings read_joints(const World& world, const std::vector<ObjectId>& joints) {
  JointReadings readings;
  for (const ObjectId joint : joints) {
    readings.names.push_back(world.tree().at(joint).name);
    readings.positions.push_back(world.joints().position(joint));
    readings.velocities.push_back(world.joints().velocity(joint));
    readings.efforts.push_back(world.joints().motor_effort(joint));
  }
  return readings;
}

void joint_state(Fields& fields, const Header& header, const JointReadings& joints) {
  put(fields, header);
  fields.put("name", joints.names);
  fields.array("position", joints.positions);
  fields.array("velocity", joints.velocities);
  fields.array("effort", joints.efforts);
}

void transforms(Fields& fields, const std::vector<TransformReading>& readings) {
  fields.list("transforms", readings, [&](const TransformReading& reading) {
    put(fields, reading.header);
    fields.put("child_frame_id", std::string_view(reading.child_frame));
    fields.message("transform", [&] {
      put(fields, "translation", reading.pose.position);
      put(fields, "rotation", reading.pose.orientation);
    });
  });
}

}  // namespace bubblesim::reading_messages
