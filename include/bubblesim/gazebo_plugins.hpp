// SPDX-License-Identifier: BSD-3-Clause
// Gazebo plugins of robot models, as a system of a simulation.
#pragma once

#include "bubblesim/python_system.hpp"

namespace bubblesim {

/// Implements the Gazebo plugins that are named in <plugin> elements: drives models and publishes their sensors. An
/// unknown plugin, or one with wrong parameters, is reported on stderr; its model runs without it. Without a bridge it
/// only reports. Add it before the scripts: scripts may then override the plugins' commands, and receive their messages
/// in the same step.
class GazeboPlugins final : public PythonSystem {
 public:
  /// `follows_rates`: the time step becomes short enough for the rates at which sensors and plugins publish.
  GazeboPlugins(PythonEngine& engine, bool follows_rates);
};

}  // namespace bubblesim
