// SPDX-License-Identifier: BSD-3-Clause
// Files of CoppeliaSim that a world includes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bubblesim/error.hpp"
#include "bubblesim/scene.hpp"

namespace bubblesim {

struct ForeignInclude {
  std::filesystem::path file;
  std::string name;   ///< unique in the scene
  std::string alias;  ///< of the objects at the top of the file, in paths; empty: theirs
  Pose pose;          ///< moves all of the file's models
};

/// Adds the models of the file to the scene. Throws SceneError for a file that cannot be read.
void include_foreign_models(const ForeignInclude& include, SceneDescription& scene, std::vector<Problem>& warnings);

}  // namespace bubblesim
