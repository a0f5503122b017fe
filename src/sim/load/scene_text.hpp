// SPDX-License-Identifier: BSD-3-Clause
// Converts files that SDFormat does not accept.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "bubblesim/scene_loader.hpp"

namespace bubblesim {

struct SceneText {
  std::string text;
  std::string name;  ///< its name in errors
};

/// The text to read in place of a file: a .xacro file expanded by xacro; a file that is not in UTF-8; a file with a
/// comment before its XML declaration. Empty for all others.
/// Throws SceneError.
std::optional<SceneText> scene_text(const std::filesystem::path& file, const XacroArguments& arguments);

}  // namespace bubblesim
