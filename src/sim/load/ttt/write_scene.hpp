// SPDX-License-Identifier: BSD-3-Clause
// A file of CoppeliaSim as an SDFormat scene: scene.sdf, with meshes, textures and scripts in folders beside it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "load/ttt/scene_file.hpp"

namespace bubblesim::ttt {

/// The name of the scene's file in its folder.
constexpr const char* kSceneFile = "scene.sdf";
/// The name of the file that lists what does not come over, a line for each.
constexpr const char* kLeftOutFile = "left_out.txt";

/// The name of the floor that a model gets; no part of the file has it.
constexpr const char* kFloor = "ground_plane";

/// Writes into an empty folder; returns the lines of what does not come over. A model gets a floor. Throws
/// std::runtime_error when a file cannot be written.
std::vector<std::string> write_scene(const SceneFile& file, const std::string& name,
                                     const std::filesystem::path& folder);

}  // namespace bubblesim::ttt
