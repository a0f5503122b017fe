// SPDX-License-Identifier: BSD-3-Clause
// Which file a scene's name means.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace bubblesim {

/// The file of a scene by name, looked for in scene_folders(), or by path. Throws SceneError when there is none.
std::filesystem::path find_scene(const std::string& name_or_path);

/// A folder of what comes with bubblesim: in an install space it lies in share/, in a development space `source` has
/// it.
std::filesystem::path shared_folder(const std::string& name, const std::filesystem::path& source);

/// The folders that an environment variable names, between colons; none when it is not set.
std::vector<std::filesystem::path> folders_of(const char* variable);

}  // namespace bubblesim
