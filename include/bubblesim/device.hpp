// SPDX-License-Identifier: BSD-3-Clause
// A device of a robot that is called before physics substeps, such as a controller, a propeller or a drive.
#pragma once

#include "bubblesim/world.hpp"

namespace bubblesim {

/// Registered by World::add_device(). Its functions are called by the thread that advances the world; they must neither
/// add nor remove models or devices, nor reset the world.
class Device {
 public:
  virtual ~Device() = default;
  /// Reads the world, applies wrenches and sets the targets of joints. `time` is the simulation time in s at the start
  /// of the substep; `duration` the time in s until the next update, for which the wrenches act. An exception ends
  /// World::advance().
  virtual void update(World& world, double time, double duration) = 0;
  /// Called after the world was reset.
  virtual void reset(World& world);
  /// Saves or restores what determines its future updates and changes while the simulation runs.
  virtual void transfer(StateArchive& archive);
};

}  // namespace bubblesim
