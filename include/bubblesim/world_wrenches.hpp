// SPDX-License-Identifier: BSD-3-Clause
// Forces and torques on links from outside the physics.
#pragma once

#include <optional>

#include "bubblesim/math.hpp"
#include "bubblesim/scene_tree.hpp"
#include "bubblesim/world_part.hpp"
#include "bubblesim/wrench.hpp"

namespace bubblesim {

class WorldWrenches : public WorldPart {
 public:
  using WorldPart::WorldPart;

  /// Pushes a link, or the canonical link of a model, during the next advance(): with a force at `point`, by default
  /// the link's centre of mass, and with a torque. `frame` is that of all three vectors. They are converted now and
  /// then constant in world axes. Wrenches add up; a sleeping body wakes. A wrench that Device::update() applies acts
  /// until the device's next update instead.
  void apply(ObjectId object, const Wrench& wrench, const std::optional<Vector3>& point = {},
             WrenchFrame frame = WrenchFrame::kWorld);
  /// Throws what apply() would throw.
  void check(ObjectId object, const Wrench& wrench, const std::optional<Vector3>& point = {}) const;
  /// Removes the forces or the torques applied so far, or both.
  void clear(ObjectId object, bool force = true, bool torque = true);
};

}  // namespace bubblesim
