// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace bubblesim {

/// A joint type of SDFormat that can be simulated.
struct JointType {
  const char* name;
  int axes;
};
const std::vector<JointType>& joint_types();

}  // namespace bubblesim
