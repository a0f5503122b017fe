// SPDX-License-Identifier: BSD-3-Clause
#include "scene/joint_types.hpp"

namespace bubblesim {

const std::vector<JointType>& joint_types() {
  static const std::vector<JointType> types = {
      {"revolute", 1},  {"continuous", 1}, {"prismatic", 1}, {"fixed", 0},   {"ball", 0},
      {"revolute2", 2}, {"universal", 2},  {"screw", 1},     {"gearbox", 2},
  };
  return types;
}

}  // namespace bubblesim
