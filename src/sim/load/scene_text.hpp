// SPDX-License-Identifier: BSD-3-Clause
// The text of a scene file.
#pragma once

#include <filesystem>
#include <string>

#include "bubblesim/scene_loader.hpp"

namespace bubblesim {

struct SceneText {
  std::string text;
  std::string name;  ///< its name in errors
};

/// The content of a file; that of a .xacro file is expanded by xacro. Throws SceneError.
SceneText scene_text(const std::filesystem::path& file, const XacroArguments& arguments);

}  // namespace bubblesim
