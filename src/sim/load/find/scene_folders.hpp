// SPDX-License-Identifier: BSD-3-Clause
// Finds the files of scenes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace bubblesim {

/// Returns the file of a scene, by name (searched in scene_folders()) or path. Throws SceneError when it is not found.
std::filesystem::path find_scene(const std::string& name_or_path);

/// A data folder of bubblesim: in share/ in an install space, `source` in a development space.
std::filesystem::path shared_folder(const std::string& name, const std::filesystem::path& source);

/// The folders in an environment variable, separated by colons; empty when it is not set.
std::vector<std::filesystem::path> folders_of(const char* variable);

}  // namespace bubblesim
