// SPDX-License-Identifier: BSD-3-Clause
// The registry of joint kinds, by SDFormat's type names; scene/joint_types.cpp has their numbers of axes.
#include <map>
#include <string>

#include "bubblesim/error.hpp"
#include "physics/joints/kinds.hpp"

namespace bubblesim {

std::unique_ptr<Joint> make_joint(dWorldID world, const JointDescription& description, const JointSite& site) {
  static const std::map<std::string, decltype(&make_hinge)> kinds = {
      {"revolute", make_hinge},      {"continuous", make_hinge}, {"prismatic", make_slider},
      {"fixed", make_fixed},         {"ball", make_ball},        {"revolute2", make_hinge2},
      {"universal", make_universal}, {"screw", make_screw},      {"gearbox", make_gearbox},
  };
  const auto kind = kinds.find(description.type);
  if (kind == kinds.end()) {
    throw InvalidInput("joint '" + description.name + "': unknown type '" + description.type + "'");
  }
  return kind->second(world, description, site);
}

}  // namespace bubblesim
