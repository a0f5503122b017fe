// SPDX-License-Identifier: BSD-3-Clause
// What follows the messages of scripts: recording, and lockstep with a controller, as a system of a simulation.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bubblesim/python_system.hpp"

namespace bubblesim {

struct ObserverOptions {
  /// Bag file for the messages that scripts publish and receive; empty: none.
  std::filesystem::path record;
  /// Lockstep: each step waits for one message on each of these topics.
  std::vector<std::string> lockstep;
};

/// Needs a bridge. Create it before the scripts, which get their bridge from it; add it as the last system, so that it
/// sees the end of a step.
class Observers final : public PythonSystem {
 public:
  /// Throws std::runtime_error when the bag cannot be written.
  Observers(PythonEngine& engine, const ObserverOptions& options);
  /// Closes the bag.
  ~Observers() override;
};

}  // namespace bubblesim
