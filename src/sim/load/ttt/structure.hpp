// SPDX-License-Identifier: BSD-3-Clause
// What the objects of a file are for a simulation: which are bodies, what moves with them, and what connects them.
#pragma once

#include <map>
#include <vector>

#include "bubblesim/math.hpp"
#include "load/ttt/scene_file.hpp"

namespace bubblesim::ttt {

constexpr int kNone = -1;   ///< no object
constexpr int kWorld = -1;  ///< the body of what does not move

/// An object in the tree. Indices are places in SceneFile::objects.
struct Node {
  int parent = kNone;
  std::vector<int> children;  ///< in their order
  Pose world;                 ///< the object's frame
  Pose moving;                ///< the frame of its children: beyond a joint's position
  unsigned model_flags = 0;   ///< of the object and all above it
  int body = kWorld;          ///< what it moves with, an index of Structure::bodies
  bool is_visible = true;     ///< by its layers and flags
};

/// What moves as one piece.
struct Body {
  int shape = kNone;         ///< the object that makes it: not static
  std::vector<int> members;  ///< all objects that move with it, itself first
};

enum class ConnectionKind {
  kJoint,  ///< `object` is a joint in dynamic mode
  kRigid,  ///< `object` is a force sensor
  kWeld,   ///< `object` is a dummy, whose partner is on the child
};

struct Connection {
  ConnectionKind kind = ConnectionKind::kJoint;
  int object = kNone;
  int parent = kWorld;  ///< a body
  int child = kWorld;   ///< a body, never the world
};

struct Structure {
  std::vector<Node> nodes;  ///< as many as objects
  std::vector<int> roots;   ///< the objects at the top, in their order
  std::vector<Body> bodies;
  std::vector<Connection> connections;
  std::map<int, int> places;  ///< of the objects, by handle

  /// The place of an object; kNone if there is none of that handle.
  int place(int handle) const {
    const auto found = places.find(handle);
    return found == places.end() ? kNone : found->second;
  }
};

/// Broken or circular parents are left out: such objects are at the top.
Structure structure_of(const SceneFile& file);

/// From the frame of a joint to that of its children.
Pose motion_of(const Joint& joint);

}  // namespace bubblesim::ttt
