// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "bubblesim/scene_loader.hpp"

namespace bubblesim {

/// The URDF that the program xacro makes of a file: the one on PATH, or else of the virtual environment of this build.
/// $(find PACKAGE) means a ROS package to each of its versions. Throws SceneError with what xacro says, and when there
/// is none.
std::string run_xacro(const std::filesystem::path& file, const XacroArguments& arguments);

}  // namespace bubblesim
