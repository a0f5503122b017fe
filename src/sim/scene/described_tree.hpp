// SPDX-License-Identifier: BSD-3-Clause
// From a description to the objects of a scene and their tree.
#pragma once

#include <utility>
#include <vector>

#include "bubblesim/scene.hpp"
#include "bubblesim/scene_tree.hpp"

namespace bubblesim {

/// Adds the described objects to a tree: first all of them where SDFormat nests them, so that handles do not depend on
/// the tree, then those with a TreePlace move there.
class DescribedTree {
 public:
  explicit DescribedTree(SceneTree& tree) : tree_(tree) {}

  /// Returns the model's handle.
  ObjectId add(const ModelDescription& model);
  /// A frame of no model, with its index among those.
  ObjectId add(const FrameDescription& frame, std::size_t index);

  /// Moves the objects that were added to their places; a parent that was not added stands for the top.
  void arrange();

 private:
  struct Placed {
    ObjectId object = kNoObject;
    TreePlace place;
  };

  template <class Part>
  ObjectId add_placed(ObjectKind kind, std::string name, ObjectId part_of, std::size_t index, const Part& part) {
    const ObjectId id = tree_.add(kind, std::move(name), part_of, index, part.alias);
    if (part.place) placed_.push_back({id, *part.place});
    return id;
  }

  SceneTree& tree_;
  std::vector<Placed> placed_;
  std::vector<ObjectId> hidden_;
};

}  // namespace bubblesim
