// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/sdf_joints.hpp"

#include <cmath>
#include <limits>
#include <optional>
#include <sdf/JointAxis.hh>
#include <utility>

#include "bubblesim/nearest_names.hpp"
#include "check/checks.hpp"
#include "load/sdf/sdf_names_and_axes.hpp"
#include "load/sdf/sdf_sensors.hpp"
#include "load/sdf/sdf_source.hpp"
#include "load/sdf_extensions.hpp"
#include "scene/describe.hpp"

namespace bubblesim {
namespace {

// SDFormat has +-1e16 for no limit.
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

/// SDFormat 1.11 has <mimic joint="..." axis="...">; older files may use <bubblesim:mimic>.
std::optional<MimicDescription> read_mimic(const sdf::ElementPtr& axis, LoadContext& reading) {
  for (auto element = axis->GetFirstElement(); element != nullptr; element = element->GetNextElement()) {
    if (element->GetName() != "mimic" && element->GetName() != "bubblesim:mimic") continue;
    MimicDescription mimic;
    if (element->HasAttribute("joint")) mimic.joint = element->GetAttribute("joint")->GetAsString();
    if (element->HasAttribute("axis")) mimic.axis = element->GetAttribute("axis")->GetAsString() == "axis2" ? 1 : 0;
    mimic.multiplier = own_number(element, "multiplier", reading.problems()).value_or(1);
    mimic.offset = own_number(element, "offset", reading.problems()).value_or(0);
    mimic.reference = own_number(element, "reference", reading.problems()).value_or(0);
    return mimic;
  }
  return std::nullopt;
}

/// Metres per turn, from an element in one of two conventions.
double read_screw_lead(const sdf::Joint& joint, const std::string& path, LoadContext& reading) {
  const sdf::ElementPtr element = joint.Element();
  // SDFormat 1.10: metres per turn, right-handed.
  if (const auto lead = own_number(element, "screw_thread_pitch", reading.problems())) return *lead;
  // Before: radians per metre, left-handed.
  if (joint.ThreadPitch() != 0) return -2 * M_PI / joint.ThreadPitch();
  reading.report(source_of(element, "thread_pitch"), path, "<thread_pitch> is 0, it must not be 0");
  return 1;
}

/// A position limit; `none` when it is out of reach.
double reachable(double limit, double none, const std::string& name, const sdf::JointAxis& axis,
                 const std::string& path, LoadContext& reading) {
  if (std::abs(limit) >= kNoLimit) return none;
  if (!(std::abs(limit) > kMaxDistance)) return limit;
  reading.warn(source_of(axis.Element()->FindElement("limit"), name), path,
               "the " + name + " limit is " + text(limit) + ", beyond 1e6: treated as no limit");
  return none;
}

AxisDescription read_axis(const sdf::JointAxis& axis, const sdf::Joint& joint, const std::string& path,
                          LoadContext& reading) {
  const auto limit = [](double value, double none) { return std::abs(value) < kNoLimit ? value : none; };
  const double none = std::numeric_limits<double>::infinity();
  AxisDescription description;
  reading.take(axis.ResolveXyz(description.direction, joint.Name()), path);
  if (joint.Type() != sdf::JointType::CONTINUOUS) {
    description.lower = reachable(axis.Lower(), -none, "lower", axis, path, reading);
    description.upper = reachable(axis.Upper(), none, "upper", axis, path, reading);
  }
  // A negative effort or velocity means no limit; many files have a velocity of 0, which Gazebo's motors ignore.
  description.max_force = axis.Effort() < 0 ? none : limit(axis.Effort(), none);
  description.max_velocity = axis.MaxVelocity() <= 0 ? none : limit(axis.MaxVelocity(), none);
  description.friction = axis.Friction();
  description.damping = axis.Damping();
  description.spring_stiffness = axis.SpringStiffness();
  description.spring_reference = axis.SpringReference();
  description.mimic = read_mimic(axis.Element(), reading);
  if (const auto motor = own_text(axis.Element(), "bubblesim:motor")) {
    if (*motor == "velocity") {
      description.motor = MotorMode::kVelocity;
    } else if (*motor == "position") {
      description.motor = MotorMode::kPosition;
    } else if (*motor == "effort") {
      description.motor = MotorMode::kEffort;
    } else {
      reading.report(source_of(axis.Element(), "bubblesim:motor"), path,
                     "<bubblesim:motor> is '" + *motor + "', it must be velocity, position or effort" +
                         did_you_mean(*motor, {"velocity", "position", "effort"}));
    }
  }
  return description;
}

/// Old models omit one or both axes of a universal joint: these are at right angles to the others.
void complete_universal(JointDescription& joint) {
  if (joint.axes.empty()) joint.axes.emplace_back().direction = Vector3::UnitX;
  if (joint.axes.size() > 1) return;
  const Vector3& first = joint.axes.front().direction;
  const Vector3 beside = first.Abs().Y() < 0.9 ? Vector3::UnitY : Vector3::UnitZ;
  joint.axes.emplace_back().direction = (beside - first * first.Dot(beside)).Normalized();
}

}  // namespace

JointDescription read_joint(const sdf::Joint& joint, const std::string& model_path, LoadContext& reading) {
  const std::string path = model_path + "/" + joint.Name();
  JointDescription description;
  description.name = joint.Name();
  description.alias = read_alias(joint.Element(), path, reading);
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
                     "the <pose> of a joint's sensor is relative to the joint: remove relative_to");
    }
    if (auto read = read_sensor(sensor, path, sensor.RawPose(), reading))
      description.sensors.push_back(std::move(*read));
  }
  if (description.type == "universal") complete_universal(description);
  if (description.type == "screw") description.screw_lead = read_screw_lead(joint, path, reading);
  if (description.type == "gearbox") {
    const sdf::ElementPtr element = joint.Element();
    description.gearbox_ratio = element->Get<double>("gearbox_ratio", 1.0).first;
    description.gearbox_reference = element->Get<std::string>("gearbox_reference_body", "").first;
    if (description.axes.size() == 1) description.axes.push_back(description.axes.front());
  }
  return description;
}

}  // namespace bubblesim
