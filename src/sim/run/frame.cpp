// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/frame.hpp"

#include <set>

namespace bubblesim {

FrameLayout frame_layout(const World& world) {
  const SceneTree& tree = world.tree();
  const std::set<ObjectId>& moved = world.moved_statics();
  FrameLayout layout;
  layout.revision = world.revision();
  for (const ObjectId model : tree.models()) {
    const std::vector<ObjectId> links = tree.parts(model, ObjectKind::kLink);
    if (world.models().description(model).is_static) {
      for (const ObjectId link : links) {
        if (moved.count(link) > 0) layout.links.push_back(link);
      }
      continue;
    }
    layout.links.insert(layout.links.end(), links.begin(), links.end());
    for (const ObjectId joint : tree.parts(model, ObjectKind::kJoint)) {
      for (int axis = 0; axis < world.joints().axes(joint); ++axis) layout.axes.push_back({joint, axis});
    }
  }
  return layout;
}

}  // namespace bubblesim
