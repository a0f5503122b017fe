// SPDX-License-Identifier: BSD-3-Clause
// Frames, which are objects without physics, and changes of the tree of objects.
#pragma once

#include <string>

#include "bubblesim/scene.hpp"
#include "bubblesim/scene_tree.hpp"
#include "bubblesim/world_part.hpp"

namespace bubblesim {

class WorldFrames : public WorldPart {
 public:
  using WorldPart::WorldPart;

  /// Adds a dummy, a frame at the origin of the world and the top of the tree; resets keep it.
  ObjectId add_dummy(std::string name);
  /// Adds a joint without physics like a dummy: a revolute, continuous, prismatic or ball joint about or along the z
  /// axis of its frame, at its position 0. Throws InvalidInput for other types.
  ObjectId add_joint(std::string name, const std::string& type);
  /// Sets the limits of a joint that was added, rad or m; infinite for none. Throws InvalidInput for others, and if
  /// `lower` is above `upper`.
  void set_joint_limits(ObjectId joint, double lower, double upper);
  /// Throws WrongObject for other objects. What is below it in the tree is at the top then, and stays where it is.
  void remove_dummy(ObjectId dummy);
  /// Throws WrongObject for other objects.
  FrameKind kind(ObjectId frame) const;
  /// The link that carries a frame, kNoObject for the world. Throws WrongObject for other objects.
  ObjectId link(ObjectId frame) const;
  /// The place of a frame in its file's tree; null for a dummy that was added, and where the file has none.
  const TreePlace* place(ObjectId frame) const;
  /// Changes the tree: the object becomes the last child of `parent`, kNoObject is the top. Nothing moves. A frame, or
  /// a link of a static model, is carried from now on by what carries the parent, below a joint by the joint's child;
  /// physics does not change.
  /// Throws InvalidInput when the parent is the object itself or below it. Resets keep the tree.
  void set_parent(ObjectId object, ObjectId parent);
  /// Sets the name in paths; resets keep it.
  void set_alias(ObjectId object, std::string alias);
};

}  // namespace bubblesim
