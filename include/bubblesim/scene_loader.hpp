// SPDX-License-Identifier: BSD-3-Clause
// From a name or an SDFormat file to a SceneDescription.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bubblesim/scene.hpp"

namespace bubblesim {

/// Folders that are searched for <name>.sdf: those of BUBBLESIM_SCENE_PATH (colon-separated), then the scenes shipped.
std::vector<std::filesystem::path> scene_folders();

/// Names of the scenes in these folders, sorted.
std::vector<std::string> scene_names();

/// What a .xacro file is expanded with: NAME:=VALUE each.
using XacroArguments = std::vector<std::string>;

/// Loads a scene by name ("tricycle") or path ("my/robot.sdf"). A file that holds a model and no world is put
/// on a ground plane. Other files than .xacro leave the arguments alone. Throws SceneError with every problem of the
/// file at once.
SceneDescription load_scene(const std::string& name_or_path, const XacroArguments& arguments = {});

/// Reads a model from the text of an SDFormat or URDF file; child scripts lie in `folder`. Throws SceneError with every
/// problem of the text at once, as in a file named <data-string>.
ModelDescription load_model(const std::string& text, const std::filesystem::path& folder);

}  // namespace bubblesim
