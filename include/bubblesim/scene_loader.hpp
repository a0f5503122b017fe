// SPDX-License-Identifier: BSD-3-Clause
// Loads SDFormat files, by name or path.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "bubblesim/error.hpp"
#include "bubblesim/prepared_scene.hpp"
#include "bubblesim/scene.hpp"

namespace bubblesim {

/// Folders that are searched for <name>.sdf: BUBBLESIM_SCENE_PATH (colon-separated), then the installed scenes.
std::vector<std::filesystem::path> scene_folders();

/// Names of the scenes in these folders, sorted.
std::vector<std::string> scene_names();

/// Whether the name ends like that of a file of CoppeliaSim, which has its scripts in itself.
bool is_foreign_scene(const std::filesystem::path& file);

/// Arguments of a .xacro file, each NAME:=VALUE.
using XacroArguments = std::vector<std::string>;

/// Loads a scene by name ("tricycle") or path ("my/robot.sdf"). A model file without a world is placed on a ground
/// plane. The arguments are used for .xacro files only. Throws SceneError with all problems of the file.
std::shared_ptr<const Scene> load_scene(const std::string& name_or_path, const XacroArguments& arguments = {});

/// Reads and checks a scene like load_scene(), to change it before it is simulated. Adds the warnings to `warnings`,
/// unless it is null.
SceneDescription read_scene(const std::string& name_or_path, const XacroArguments& arguments = {},
                            std::vector<Problem>* warnings = nullptr);

/// A ground plane and a light, without a file.
std::shared_ptr<const Scene> empty_scene();

/// Reads a model from the text of an SDFormat or URDF file. Child scripts are searched in `folder`. Adds the warnings
/// to `warnings`, unless it is null. Throws SceneError with all problems of the text; the file name in them is
/// <data-string>.
ModelDescription load_model(const std::string& text, const std::filesystem::path& folder,
                            std::vector<Problem>* warnings = nullptr);

/// Reads a file of CoppeliaSim as models for a scene that runs, at their poses in the file and without a floor. Names
/// of models, links, joints, sensors and frames get the suffix, so that they are new in that scene; aliases, and so the
/// paths of scripts, stay. Objects without physics belong to the first model. Throws SceneError, also for a file
/// without shapes.
std::vector<ModelDescription> load_foreign_models(const std::filesystem::path& file, const std::string& suffix,
                                                  std::vector<Problem>* warnings = nullptr);

}  // namespace bubblesim
