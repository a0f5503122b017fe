// SPDX-License-Identifier: BSD-3-Clause
#include "sdf_joints.hpp"

#include <cmath>
#include <limits>
#include <sdf/JointAxis.hh>
#include <utility>

#include "bubblesim/nearest_names.hpp"
#include "own_elements.hpp"
#include "sdf_sensors.hpp"
#include "sdf_source.hpp"

namespace bubblesim {
namespace {

// SDFormat writes a limit that does not exist as +-1e16.
constexpr double kNoLimit = 1e15;

const char* sdf_type(sdf::JointType type) {
  switch (type) {
    case sdf::JointType::BALL:
      return "ball";
    case sdf::JointType::CONTINUOUS:
      return "continuous";
    case sdf::JointType::FIXED:
      return "fixed";
    case sdf::JointType::GEARBOX:
      return "gearbox";
    case sdf::JointType::PRISMATIC:
      return "prismatic";
    case sdf::JointType::REVOLUTE:
      return "revolute";
    case sdf::JointType::REVOLUTE2:
      return "revolute2";
    case sdf::JointType::SCREW:
      return "screw";
    case sdf::JointType::UNIVERSAL:
      return "universal";
    case sdf::JointType::INVALID:
      break;
  }
  return "invalid";
}

AxisDescription read_axis(const sdf::JointAxis& axis, const sdf::Joint& joint, const std::string& path,
                          SceneReading& reading) {
  const auto limit = [](double value, double none) { return std::abs(value) < kNoLimit ? value : none; };
  const double none = std::numeric_limits<double>::infinity();
  AxisDescription description;
  reading.take(axis.ResolveXyz(description.direction, joint.Name()), path);
  if (joint.Type() != sdf::JointType::CONTINUOUS) {
    description.lower = limit(axis.Lower(), -none);
    description.upper = limit(axis.Upper(), none);
  }
  // A negative effort or velocity means that there is no limit.
  description.max_force = axis.Effort() < 0 ? none : limit(axis.Effort(), none);
  description.max_velocity = axis.MaxVelocity() < 0 ? none : limit(axis.MaxVelocity(), none);
  description.friction = axis.Friction();
  description.damping = axis.Damping();
  if (const auto motor = own_text(axis.Element(), "bubblesim:motor")) {
    if (*motor == "velocity") {
      description.motor = MotorMode::kVelocity;
    } else if (*motor == "position") {
      description.motor = MotorMode::kPosition;
    } else {
      reading.report(source_of(axis.Element(), "bubblesim:motor"), path,
                     "<bubblesim:motor> is '" + *motor + "', it must be velocity or position" +
                         did_you_mean(*motor, {"velocity", "position"}));
    }
  }
  return description;
}

}  // namespace

JointDescription read_joint(const sdf::Joint& joint, const std::string& model_path, SceneReading& reading) {
  const std::string path = model_path + "/" + joint.Name();
  JointDescription description;
  description.name = joint.Name();
  description.type = sdf_type(joint.Type());
  description.source = source_of(joint.Element());
  reading.take(joint.ResolveParentLink(description.parent), path);
  reading.take(joint.ResolveChildLink(description.child), path);
  description.pose = reading.resolved(joint, path, "__model__");
  const bool wants_axes = description.type != "fixed" && description.type != "ball";
  for (unsigned int i = 0; wants_axes && i < 2; ++i) {
    if (joint.Axis(i) != nullptr) description.axes.push_back(read_axis(*joint.Axis(i), joint, path, reading));
  }
  for (std::uint64_t i = 0; i < joint.SensorCount(); ++i) {
    const sdf::Sensor& sensor = *joint.SensorByIndex(i);
    if (!sensor.PoseRelativeTo().empty()) {  // SDFormat does not resolve it here
      reading.report(source_of(sensor.Element(), "pose"), path + "/" + sensor.Name(),
                     "the <pose> of a joint's sensor is in the joint's frame: take relative_to out");
    }
    if (auto read = read_sensor(sensor, path, sensor.RawPose(), reading))
      description.sensors.push_back(std::move(*read));
  }
  return description;
}

}  // namespace bubblesim
