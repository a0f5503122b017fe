// SPDX-License-Identifier: BSD-3-Clause
// How the registry finds a kind whose class only its own file knows.
#pragma once

#include "physics/joints/joint.hpp"
#include "scene/joint_kind.hpp"

namespace bubblesim {

/// The file of a kind instantiates it: template const JointKind& joint_kind<ScrewKind>();
template <class Kind>
const JointKind& joint_kind() {
  static const Kind kind;
  return kind;
}

}  // namespace bubblesim
