// SPDX-License-Identifier: BSD-3-Clause
// The connections between bodies as joints of a model.
#pragma once

#include <functional>

#include "load/ttt/groups.hpp"
#include "load/ttt/write_parts.hpp"

namespace bubblesim::ttt {

/// What the joints of a model refer to.
struct JointSite {
  std::function<std::string(int body)> link;  ///< the name of a body's link, also of the fixed part (kWorld)
  bool has_loops = false;                     ///< the joints' zeros are at their positions in the file
  std::map<int, std::string> names;           ///< of the joints, by the handle of their object
};

/// Whether a target velocity is that of the program of the last run: a hinge would be at its stop in half a second.
bool is_left_over(const Joint& joint);
/// SDFormat's name of the type.
const char* type_of(const Joint& joint);
void write_joint(pugi::xml_node model, const Connection& connection, const JointSite& site, Conversion& conversion);

}  // namespace bubblesim::ttt
