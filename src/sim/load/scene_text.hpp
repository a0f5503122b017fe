// SPDX-License-Identifier: BSD-3-Clause
// Files that SDFormat does not take as they are.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "bubblesim/scene_loader.hpp"

namespace bubblesim {

struct SceneText {
  std::string text;
  std::string name;  ///< what errors call it
};

/// What is to be read in place of a file: a .xacro as xacro expands it, a scene of before SDFormat 1.3, whose root was
/// <gazebo>, one that is not in UTF-8, and one with a comment before its XML declaration. Nothing for all others.
/// Throws SceneError.
std::optional<SceneText> scene_text(const std::filesystem::path& file, const XacroArguments& arguments);

}  // namespace bubblesim
