// SPDX-License-Identifier: BSD-3-Clause
// The devices that a world calls before its physics substeps.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "bubblesim/scene_tree.hpp"
#include "bubblesim/world_part.hpp"

namespace bubblesim {

class Device;

/// What becomes of the contacts of two shapes in one substep.
struct ContactAnswer {
  bool resist = true;              ///< whether the shapes resist each other
  std::optional<double> friction;  ///< coefficient in place of the surfaces' own, >= 0
};

/// Decides about two links whose shapes touch; static links come second. Must not throw.
using ContactFilter = std::function<ContactAnswer(ObjectId first, ObjectId second)>;

class WorldDevices : public WorldPart {
 public:
  using WorldPart::WorldPart;

  /// Calls a device before physics substeps, after those added before it, until it is removed or `model` is; kNoObject
  /// for the world. `rate` in Hz; 0 for each substep. A rate that the substeps do not divide is kept in the mean.
  void add(std::shared_ptr<Device> device, ObjectId model = kNoObject, double rate = 0);
  /// Does nothing when the device was removed with its model.
  void remove(const Device& device);

  /// Is asked in each substep for each pair of shapes that touch, by the thread that advances the world; it may move
  /// objects. An empty one removes it. It is not a part of the world's state.
  void set_contact_filter(ContactFilter filter);
};

}  // namespace bubblesim
