// SPDX-License-Identifier: BSD-3-Clause
// Gazebo plugins of robot models, as a system of a simulation.
#pragma once

#include <memory>

#include "bubblesim/child_scripts.hpp"
#include "bubblesim/simulation.hpp"

namespace bubblesim {

/// Implements the Gazebo plugins that are named in <plugin> elements: drives models and publishes their sensors. An
/// unknown plugin, or one with wrong parameters, is reported on stderr; its model runs without it.
class GazeboPlugins final : public System {
 public:
  /// Uses the interpreter and bridge of the scripts. The bridge must not be null, and the scripts must outlive this
  /// object. Add it before the scripts: scripts may then override the plugins' commands, and receive their messages in
  /// the same step.
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
