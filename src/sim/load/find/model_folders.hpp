// SPDX-License-Identifier: BSD-3-Clause
// Where the models and files lie that scenes name.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace bubblesim {

/// In the order in which they are searched: the scene's own and its subfolder `models`, BUBBLESIM_MODEL_PATH,
/// GAZEBO_MODEL_PATH, GAZEBO_RESOURCE_PATH, GZ_SIM_RESOURCE_PATH, IGN_GAZEBO_RESOURCE_PATH, the folder around the
/// scene's, and `models` in each of scene_folders().
std::vector<std::filesystem::path> model_folders(const std::filesystem::path& scene_folder);

/// The file or folder that a URI means: model://NAME/..., package://NAME/..., file://PATH or a path; a model of a
/// server, https://.../models/NAME, is looked for as model://NAME, and model://name. Nothing when there is none.
std::filesystem::path find_model(const std::string& uri, const std::filesystem::path& scene_folder);

/// The same for a URI that `naming_file` holds: paths start beside it, and what it says of its own model is found
/// there, whatever the model's folder is called.
std::filesystem::path find_resource(const std::string& uri, const std::filesystem::path& naming_file,
                                    const std::filesystem::path& scene_folder);

}  // namespace bubblesim
