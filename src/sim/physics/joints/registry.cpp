// SPDX-License-Identifier: BSD-3-Clause
// The registry of joint kinds. A new kind is a file in this folder and a line here.
#include <array>
#include <string>

#include "bubblesim/error.hpp"
#include "physics/joints/joint.hpp"
#include "scene/joint_kind.hpp"

namespace bubblesim {

/// Instantiated by the file of each kind (define.hpp).
template <class Kind>
const JointKind& joint_kind();

// clang-format off
const std::array kJointKinds = {
    &joint_kind<class RevoluteKind>,
    &joint_kind<class ContinuousKind>,
    &joint_kind<class PrismaticKind>,
    &joint_kind<class FixedKind>,
    &joint_kind<class BallKind>,
    &joint_kind<class Revolute2Kind>,
    &joint_kind<class UniversalKind>,
    &joint_kind<class ScrewKind>,
    &joint_kind<class GearboxKind>,
};
// clang-format on

const std::vector<const JointKind*>& joint_kinds() {
  static const std::vector<const JointKind*> kinds = [] {
    std::vector<const JointKind*> list;
    for (const auto kind : kJointKinds) list.push_back(&kind());
    return list;
  }();
  return kinds;
}

const JointKind* find_joint_kind(std::string_view name) {
  for (const JointKind* kind : joint_kinds()) {
    if (kind->name == name) return kind;
  }
  return nullptr;
}

std::unique_ptr<Joint> make_joint(dWorldID world, const JointDescription& description, const JointSite& site) {
  const JointKind* kind = find_joint_kind(description.type);
  if (kind == nullptr) {
    throw InvalidInput("joint '" + description.name + "': unknown type '" + description.type + "'");
  }
  return kind->make(world, description, site);
}

}  // namespace bubblesim
