// SPDX-License-Identifier: BSD-3-Clause
// What the plugins of Gazebo's robots do, as a system of a simulation.
#pragma once

#include <memory>

#include "bubblesim/child_scripts.hpp"
#include "bubblesim/simulation.hpp"

namespace bubblesim {

/// Drives models and publishes their sensors as their <plugin> elements ask for. A plugin that is not known, or whose
/// parameters are wrong, is reported on stderr; its model runs without it.
class GazeboPlugins final : public System {
 public:
  /// They use the scripts' interpreter and bridge, of which there must be one; the scripts must outlive them. To be
  /// added before the scripts: these may overrule what a device commands, and hear last of a step.
  GazeboPlugins(Simulation& simulation, const ChildScripts& scripts);
  ~GazeboPlugins() override;

  void actuate(World& world, double time) override;
  void publish(const World& world, double time) override;
  void reset() override;
  void model_added(World& world, ObjectId model) override;
  void model_removing(World& world, ObjectId model) override;

 private:
  struct Python;
  Simulation& simulation_;
  std::unique_ptr<Python> python_;
};

}  // namespace bubblesim
