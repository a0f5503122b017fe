// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "bubblesim/scene_loader.hpp"

namespace bubblesim {

/// Expands a file to URDF with the program xacro: the one on PATH, or else that of the virtual environment of this
/// build. $(find PACKAGE) refers to ROS packages in every version of xacro. Throws SceneError with xacro's error, and
/// when xacro is not found.
std::string run_xacro(const std::filesystem::path& file, const XacroArguments& arguments);

}  // namespace bubblesim
