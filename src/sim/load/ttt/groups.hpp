// SPDX-License-Identifier: BSD-3-Clause
// Which models a file becomes: bodies that are connected, and trees that do not move.
#pragma once

#include <map>
#include <vector>

#include "load/ttt/structure.hpp"

namespace bubblesim::ttt {

/// A model. If it has bodies and a fixed part, joints of it lead to the fixed part.
struct Group {
  std::vector<int> bodies;       ///< the one that comes first in the tree first
  int fixed = kNone;             ///< the object at the top of a tree whose objects without a body belong to it
  std::vector<int> members;      ///< those objects; empty if there is no fixed part
  std::vector<int> connections;  ///< of its bodies
  /// Of each body, where all joints are at their zero; empty: loops cannot be at zero, so the poses are those of the
  /// file.
  std::map<int, Pose> at_zero;

  int leader(const Structure& structure) const {
    return fixed != kNone ? fixed : structure.bodies[static_cast<std::size_t>(bodies.front())].shape;
  }
};

std::vector<Group> groups_of(const SceneFile& file, const Structure& structure);

}  // namespace bubblesim::ttt
