// SPDX-License-Identifier: BSD-3-Clause
// Saved states in files.
#pragma once

#include <filesystem>

#include "bubblesim/simulation.hpp"

namespace bubblesim::app {

/// Throw std::runtime_error with the file when it cannot be read or written, or does not fit the simulation.
void load_state(Simulation& simulation, const std::filesystem::path& file);
/// Replaces the file as a whole.
void save_state(Simulation& simulation, const std::filesystem::path& file);

}  // namespace bubblesim::app
