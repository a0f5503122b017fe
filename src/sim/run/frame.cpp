// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/frame.hpp"

namespace bubblesim {

FrameLayout frame_layout(const World& world) {
  const SceneTree& tree = world.tree();
  FrameLayout layout;
  layout.revision = world.revision();
  for (const ObjectId model : tree.models()) {
    if (world.models().description(model).is_static) continue;
    const std::vector<ObjectId> links = tree.parts(model, ObjectKind::kLink);
    layout.links.insert(layout.links.end(), links.begin(), links.end());
    for (const ObjectId joint : tree.parts(model, ObjectKind::kJoint)) {
      for (int axis = 0; axis < world.joints().axes(joint); ++axis) layout.axes.push_back({joint, axis});
    }
  }
  return layout;
}

}  // namespace bubblesim
