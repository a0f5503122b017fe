// SPDX-License-Identifier: BSD-3-Clause
// Scenes and models of CoppeliaSim (.ttt, .ttm): another program writes them as SDFormat, within limits of time and
// memory, into a folder of the user's cache.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace bubblesim {

struct ConvertedScene {
  std::filesystem::path file;         ///< in SDFormat
  std::vector<std::string> left_out;  ///< what does not come over, a line for each
};

/// Converts a file, or returns what an earlier process made of the same content. Throws SceneError.
ConvertedScene convert_scene(const std::filesystem::path& file);

}  // namespace bubblesim
