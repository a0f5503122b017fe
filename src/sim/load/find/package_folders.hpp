// SPDX-License-Identifier: BSD-3-Clause
// Where ROS packages lie, found as rospack does but without it: the core knows no ROS.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace bubblesim {

/// The folder of a package: around `near`, below those in ROS_PACKAGE_PATH, or in share/ of those in CMAKE_PREFIX_PATH.
/// Nothing when there is none.
std::filesystem::path find_package(const std::string& name, const std::filesystem::path& near);

/// The folders that packages export to Gazebo for models and media: `gazebo_model_path` and `gazebo_media_path` of
/// <gazebo_ros>, first those of the package around `near`, then of all in ROS_PACKAGE_PATH.
std::vector<std::filesystem::path> exported_folders(const std::filesystem::path& near);

}  // namespace bubblesim
