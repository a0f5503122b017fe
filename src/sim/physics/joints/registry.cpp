// SPDX-License-Identifier: BSD-3-Clause
// The registry of joint kinds, by SDFormat's type names.
#include <string>

#include "bubblesim/error.hpp"
#include "physics/joints/kinds.hpp"

namespace bubblesim {

const std::vector<JointKind>& joint_kinds() {
  static const std::vector<JointKind> kinds = {
      {"revolute", 1, make_hinge},      {"continuous", 1, make_hinge}, {"prismatic", 1, make_slider},
      {"fixed", 0, make_fixed},         {"ball", 0, make_ball},        {"revolute2", 2, make_hinge2},
      {"universal", 2, make_universal}, {"screw", 1, make_screw},      {"gearbox", 2, make_gearbox},
  };
  return kinds;
}

std::unique_ptr<Joint> make_joint(dWorldID world, const JointDescription& description, const JointSite& site) {
  for (const JointKind& kind : joint_kinds()) {
    if (description.type == kind.type) return kind.make(world, description, site);
  }
  throw InvalidInput("joint '" + description.name + "': unknown type '" + description.type + "'");
}

}  // namespace bubblesim
