// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/models/sdf_joints.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "bubblesim/nearest_names.hpp"
#include "load/sdf/elements/own_elements.hpp"
#include "load/sdf/models/sdf_names_and_axes.hpp"
#include "load/sdf/models/sdf_sensors.hpp"
#include "load/sdf/models/sdf_tree.hpp"
#include "scene/describe.hpp"
#include "scene/joint_kind.hpp"
#include "validation/limits.hpp"

namespace bubblesim {
namespace {

// SDFormat has +-1e16 for no limit.
constexpr double kNoLimit = 1e15;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr const char* kWorld = "world";

/// The frames whose names have the longest common suffix with `wanted`.
std::vector<std::string> ending_as(const std::vector<std::string>& frames, const std::string& wanted) {
  const std::string separator = "::";
  for (std::string end = wanted;;) {
    std::vector<std::string> found;
    for (const std::string& frame : frames) {
      const bool ends = frame.size() > end.size() + 2 &&
                        frame.compare(frame.size() - end.size() - 2, std::string::npos, separator + end) == 0;
      if (frame == end || ends) found.push_back(frame);
    }
    const std::size_t scope = end.find(separator);
    if (!found.empty() || scope == std::string::npos) return found;
    end = end.substr(scope + 2);
  }
}

/// SDFormat 1.11 has <mimic joint="..." axis="...">; older files may use <bubblesim:mimic>.
std::optional<MimicDescription> read_mimic(const SdfElement& axis, const std::string& path, LoadContext& context) {
  for (const char* name : {"mimic", "bubblesim:mimic"}) {
    const SdfElement element = axis.child(name);
    if (!element) continue;
    MimicDescription mimic;
    mimic.joint = element.attribute("joint");
    mimic.axis = element.attribute("axis") == "axis2" ? 1 : 0;
    mimic.multiplier = own_number(element, "multiplier", path, context).value_or(1);
    mimic.offset = own_number(element, "offset", path, context).value_or(0);
    mimic.reference = own_number(element, "reference", path, context).value_or(0);
    return mimic;
  }
  return std::nullopt;
}

/// Reads one joint of a model.
class JointReader {
 public:
  JointReader(const SdfElement& joint, const Frames& frames, std::string path, LoadContext& context)
      : joint_(joint), frames_(frames), path_(std::move(path)), context_(context) {}

  std::optional<JointDescription> read() const {
    const auto parent = read_end("parent");
    const auto child = read_end("child");
    std::string type = joint_.attribute("type");
    std::transform(type.begin(), type.end(), type.begin(), [](unsigned char c) { return std::tolower(c); });
    const JointKind* kind = find_joint_kind(type);
    if (kind == nullptr) {
      std::vector<std::string> names;
      for (const JointKind* known : joint_kinds()) names.emplace_back(known->name);
      context_.report(joint_.source(), path_, "unknown joint type '" + type + "'" + did_you_mean(type, names));
      return std::nullopt;
    }
    if (!parent || !child) return std::nullopt;
    if (parent->link == child->link) {
      context_.report(joint_.source(), path_, "joins '" + parent->link + "' to itself: parent and child must differ");
      return std::nullopt;
    }
    JointDescription joint;
    joint.name = joint_.name();
    joint.alias = read_alias(joint_, path_, context_);
    joint.place = read_place(joint_);
    joint.type = type;
    joint.source = joint_.source();
    joint.parent = parent->link;
    joint.child = child->link;
    // By default a joint is at the frame of its child.
    const bool has_base = !base_of(joint_).empty();
    joint.pose = has_base ? frames_.pose_of(joint_, "__model__", path_, context_)
                          : frames_.pose(child->frame) * joint_.child("pose").as_pose();
    if (kind->axes > 0) read_axes(*kind, joint);
    read_sensors(joint);
    kind->read(joint_, path_, context_, joint);
    return joint;
  }

 private:
  /// The parent or child of a joint.
  struct End {
    std::string frame;  // as named in the file, or the one that is meant
    std::string link;
  };

  std::optional<End> read_end(const char* which) const {
    const SdfElement element = joint_.child(which);
    const std::string name = element.as_text();
    if (name.empty()) {
      context_.report(joint_.source(), path_, "has no <" + std::string(which) + ">: it must name a link");
      return std::nullopt;
    }
    if (name == kWorld) return End{name, name};
    std::string frame = name;
    if (!frames_.has(frame)) {
      // Gazebo finds the links of nested models under other names than SDFormat.
      const std::vector<std::string> meant = ending_as(frames_.names(), name);
      if (meant.size() != 1) {
        context_.warn(element.source(), path_,
                      "the " + std::string(which) + " '" + name + "' is not a link of this model" +
                          did_you_mean(name, frames_.names()) + ": this joint is ignored");
        return std::nullopt;
      }
      frame = meant.front();
      context_.warn(joint_.source(), path_,
                    "the " + std::string(which) + " '" + name + "' is not found: using " + frame);
    }
    std::string link = frames_.link_of(frame);
    if (link.empty()) {
      context_.warn(element.source(), path_,
                    "the " + std::string(which) + " '" + name + "' is not attached to a link: this joint is ignored");
      return std::nullopt;
    }
    return End{std::move(frame), std::move(link)};
  }

  void read_axes(const JointKind& kind, JointDescription& joint) const {
    for (const char* name : {"axis", "axis2"}) {
      if (const SdfElement axis = joint_.child(name)) joint.axes.push_back(read_axis(kind, axis, joint));
    }
  }

  AxisDescription read_axis(const JointKind& kind, const SdfElement& axis, const JointDescription& joint) const {
    const auto limit = [](double value, double none) { return std::abs(value) < kNoLimit ? value : none; };
    const SdfElement limits = axis.child("limit");
    const SdfElement dynamics = axis.child("dynamics");
    AxisDescription description;
    description.direction = direction(axis, joint.pose);
    if (kind.has_limits) {
      description.lower = reachable(limits, "lower", -kInfinity);
      description.upper = reachable(limits, "upper", kInfinity);
    }
    // A negative effort or velocity means no limit; many files have a velocity of 0, which Gazebo's motors ignore.
    const double effort = limits.number("effort");
    const double velocity = limits.number("velocity");
    description.max_force = effort < 0 ? kInfinity : limit(effort, kInfinity);
    description.max_velocity = velocity <= 0 ? kInfinity : limit(velocity, kInfinity);
    description.friction = dynamics.number("friction");
    description.damping = dynamics.number("damping");
    description.spring_stiffness = dynamics.number("spring_stiffness");
    description.spring_reference = dynamics.number("spring_reference");
    description.mimic = read_mimic(axis, path_, context_);
    if (const auto motor = own_text(axis, "bubblesim:motor")) read_motor(axis, *motor, description);
    description.target = own_number(axis, "bubblesim:target", path_, context_).value_or(0);
    description.position_gain = own_number(axis, "bubblesim:position_gain", path_, context_).value_or(kPositionGain);
    return description;
  }

  void read_motor(const SdfElement& axis, const std::string& motor, AxisDescription& description) const {
    if (motor == "velocity") {
      description.motor = MotorMode::kVelocity;
    } else if (motor == "position") {
      description.motor = MotorMode::kPosition;
    } else if (motor == "effort") {
      description.motor = MotorMode::kEffort;
    } else if (motor == "callback") {
      description.by_callback = true;
    } else {
      context_.report(axis.source("bubblesim:motor"), path_,
                      "<bubblesim:motor> is '" + motor + "', it must be velocity, position, effort or callback" +
                          did_you_mean(motor, {"velocity", "position", "effort", "callback"}));
    }
  }

  /// The direction in the joint's frame.
  Vector3 direction(const SdfElement& axis, const Pose& joint_pose) const {
    const SdfElement xyz = axis.child("xyz");
    const Vector3 given = xyz.as_vector();
    if (!(given.norm() > 0)) {
      context_.report(axis.source("xyz"), path_, "<xyz> is 0 0 0: an axis needs a direction");
      return Vector3::UnitZ();
    }
    const Vector3 unit = given.normalized();
    const std::string frame = xyz.attribute("expressed_in");
    if (frame.empty() || frame == joint_.name()) return unit;
    if (!frames_.has(frame)) {
      context_.report(axis.source("xyz"), path_,
                      "<xyz> is expressed in '" + frame + "', which is not a link, joint, frame or model there" +
                          did_you_mean(frame, frames_.names()));
      return unit;
    }
    return joint_pose.orientation.conjugate() * (frames_.pose(frame).orientation * unit);
  }

  /// A position limit; `none` when it is out of reach.
  double reachable(const SdfElement& limits, const std::string& name, double none) const {
    const double limit = limits.number(name);
    if (std::abs(limit) >= kNoLimit) return none;
    if (!(std::abs(limit) > kMaxDistance)) return limit;
    context_.warn(limits.source(name), path_,
                  "the " + name + " limit is " + text(limit) + ", beyond 1e6: treated as no limit");
    return none;
  }

  void read_sensors(JointDescription& joint) const {
    for (const SdfElement& sensor : joint_.children("sensor")) {
      const std::string path = path_ + "/" + sensor.name();
      if (!base_of(sensor).empty()) {
        context_.report(sensor.source("pose"), path,
                        "the <pose> of a joint's sensor is relative to the joint: remove relative_to");
      }
      auto read = read_sensor(sensor, sensor.name(), path_, sensor.child("pose").as_pose(), context_);
      if (read) joint.sensors.push_back(std::move(*read));
    }
  }

  const SdfElement& joint_;
  const Frames& frames_;
  std::string path_;
  LoadContext& context_;
};

}  // namespace

std::optional<JointDescription> read_joint(const SdfElement& joint, const Frames& frames, const std::string& model_path,
                                           LoadContext& context) {
  return JointReader(joint, frames, model_path + "/" + joint.name(), context).read();
}

}  // namespace bubblesim
