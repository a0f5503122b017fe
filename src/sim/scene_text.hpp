// SPDX-License-Identifier: BSD-3-Clause
// Files that SDFormat does not take as they are.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace bubblesim {

struct SceneText {
  std::string text;
  std::string name;  ///< what errors call it
};

/// What is to be read in place of a file: a .xacro as xacro expands it, a scene of before SDFormat 1.3, whose root was
/// <gazebo>, and one that is not in UTF-8. Nothing for all others. Throws SceneError.
std::optional<SceneText> scene_text(const std::filesystem::path& file);

}  // namespace bubblesim
