// SPDX-License-Identifier: BSD-3-Clause
// Checks whether a joint can be simulated.
#include <algorithm>
#include <cmath>
#include <limits>

#include "bubblesim/nearest_names.hpp"
#include "scene/describe.hpp"
#include "scene/joint_kind.hpp"
#include "validation/checker.hpp"
#include "validation/limits.hpp"
#include "validation/scene_check.hpp"

namespace bubblesim {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

void check_axis(Checker& checker, const AxisDescription& axis) {
  checker.require(within(axis.direction.norm() - 1, 1e-3), "the axis", text(axis.direction), "a direction, not zero");
  checker.require(axis.lower <= axis.upper, "the lower limit", text(axis.lower),
                  "at most the upper limit " + text(axis.upper));
  for (const double limit : {axis.lower, axis.upper}) {
    checker.require(!std::isfinite(limit) || within(limit, kMaxDistance), "the limit", text(limit),
                    "infinite or at most 1e6");
  }
  checker.require(axis.lower < kInfinity && axis.upper > -kInfinity, "the range of limits",
                  text(axis.lower) + " to " + text(axis.upper), "a reachable range");
  checker.require(axis.max_force >= 0, "the effort limit", text(axis.max_force), "0 or more");
  checker.require(axis.max_velocity > 0, "the velocity limit", text(axis.max_velocity), "above 0");
  checker.require(axis.friction >= 0 && within(axis.friction, 1e9), "the friction", text(axis.friction), "0 or more");
  checker.require(axis.damping >= 0 && within(axis.damping, 1e9), "the damping", text(axis.damping), "0 or more");
  checker.require(axis.spring_stiffness >= 0 && within(axis.spring_stiffness, 1e9), "the spring's stiffness",
                  text(axis.spring_stiffness), "0 or more");
  checker.require(axis.position_gain >= 0 && within(axis.position_gain, 1e9), "the position gain",
                  text(axis.position_gain) + " 1/s", "0 or more");
  checker.require(within(axis.spring_reference, kMaxDistance), "the spring's reference", text(axis.spring_reference),
                  "finite and at most 1e6");
}

/// Whether the chain of mimicked joints leads back to this joint.
bool follows_itself(const Checker& checker, const ModelDescription& model, const JointDescription& joint) {
  const JointDescription* leader = &joint;
  for (std::size_t i = 0; i <= model.joints.size(); ++i) {
    const auto following = std::find_if(leader->axes.begin(), leader->axes.end(),
                                        [](const AxisDescription& axis) { return axis.mimic.has_value(); });
    if (following == leader->axes.end()) return false;
    leader = checker.joint_named(following->mimic->joint);
    if (leader == nullptr) return false;
  }
  return true;
}

void check_mimic(Checker& checker, const ModelDescription& model, const JointDescription& joint,
                 const MimicDescription& mimic) {
  for (const double value : {mimic.multiplier, mimic.offset, mimic.reference}) {
    checker.require(within(value, kMaxDistance), "a number of <mimic>", text(value), "finite and at most 1e6");
  }
  const JointDescription* leader = checker.joint_named(mimic.joint);
  if (leader == nullptr) {
    std::vector<std::string> names;
    for (const JointDescription& known : model.joints) names.push_back(known.name);
    checker.report("mimics the joint '" + mimic.joint + "', which this model does not have" +
                   did_you_mean(mimic.joint, names));
  } else if (mimic.axis < 0 || mimic.axis >= static_cast<int>(leader->axes.size())) {
    checker.report("mimics an axis of '" + mimic.joint + "' that this joint does not have");
  } else if (follows_itself(checker, model, joint)) {
    checker.report("mimics itself through '" + mimic.joint + "': one joint of the chain must not mimic another");
  }
}

}  // namespace

const JointDescription* hinge_between(const ModelDescription& model, const std::string& one, const std::string& other) {
  for (const JointDescription& joint : model.joints) {
    const JointKind* kind = find_joint_kind(joint.type);
    if (kind == nullptr || !kind->is_hinge) continue;
    if ((joint.parent == one && joint.child == other) || (joint.parent == other && joint.child == one)) return &joint;
  }
  return nullptr;
}

void check_joint(Checker& checker, const ModelDescription& model, const JointDescription& joint) {
  checker.check_pose(joint.pose);
  if (joint.parent != "world") checker.check_link_name(joint.parent, "parent");
  checker.check_link_name(joint.child, "child");
  if (joint.parent == joint.child) checker.report("connects the link '" + joint.parent + "' with itself");
  const JointKind* kind = find_joint_kind(joint.type);
  if (kind == nullptr) {
    std::string list;
    for (const JointKind* known : joint_kinds()) list += (list.empty() ? "" : ", ") + std::string(known->name);
    checker.report("joint type '" + joint.type + "' is not supported; supported types: " + list);
    return;
  }
  if (static_cast<int>(joint.axes.size()) != kind->axes) {
    checker.report("the number of axes is " + std::to_string(joint.axes.size()) + ", it must be " +
                   std::to_string(kind->axes) + " for a " + joint.type + " joint");
    return;
  }
  for (const AxisDescription& axis : joint.axes) {
    check_axis(checker, axis);
    if (axis.mimic) check_mimic(checker, model, joint, *axis.mimic);
  }
  kind->check(checker, model, joint);
}

}  // namespace bubblesim
