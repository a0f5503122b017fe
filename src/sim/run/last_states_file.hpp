// SPDX-License-Identifier: BSD-3-Clause
// The file with the last states before a divergence.
#pragma once

#include <string>

#include "bubblesim/world.hpp"

namespace bubblesim {

/// Writes them to the file of this process in the folder for temporary files, instead of those of the last divergence.
/// Only this user can read it. Returns its path, or an empty string when it cannot be written. Thread-safe.
std::string write_last_states(const World& world);

}  // namespace bubblesim
