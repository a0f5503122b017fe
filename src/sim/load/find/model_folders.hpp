// SPDX-License-Identifier: BSD-3-Clause
// Search paths of models and files that scenes refer to.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace bubblesim {

/// The folders in search order: the scene's own and its subfolder `models`, BUBBLESIM_MODEL_PATH, GAZEBO_MODEL_PATH,
/// GAZEBO_RESOURCE_PATH, GZ_SIM_RESOURCE_PATH, IGN_GAZEBO_RESOURCE_PATH, the folder around the scene's, and `models` in
/// each of scene_folders().
std::vector<std::filesystem::path> model_folders(const std::filesystem::path& scene_folder);

/// Returns the file or folder of a URI: model://NAME/..., package://NAME/..., file://PATH or a path. The model of a
/// server, https://.../models/NAME, is searched as model://NAME and model://name. Empty when it is not found.
std::filesystem::path find_model(const std::string& uri, const std::filesystem::path& scene_folder);

/// The same for a URI in the file `naming_file`: relative paths start in its folder, and URIs of its own model are
/// found there, whatever the name of the model's folder.
std::filesystem::path find_resource(const std::string& uri, const std::filesystem::path& naming_file,
                                    const std::filesystem::path& scene_folder);

}  // namespace bubblesim
