// SPDX-License-Identifier: BSD-3-Clause
// The scripts of a scene as files beside it.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "load/ttt/write_parts.hpp"

namespace bubblesim::ttt {

/// Whether a script runs here: child scripts, and customization scripts that filter the image of a vision sensor.
bool is_run(const Script& script);

/// Writes the scripts that run into the folder `scripts`, named after their objects. Returns their paths
/// from the folder, by the place of the object in the file.
std::map<int, std::string> write_scripts(const std::filesystem::path& folder, Conversion& conversion);

}  // namespace bubblesim::ttt
