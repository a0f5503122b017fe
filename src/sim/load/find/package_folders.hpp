// SPDX-License-Identifier: BSD-3-Clause
// Finds ROS packages like rospack does, without rospack: the core does not depend on ROS.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace bubblesim {

/// Returns the folder of a package: around `near`, below the folders in ROS_PACKAGE_PATH, or in share/ of those in
/// CMAKE_PREFIX_PATH. Empty when it is not found.
std::filesystem::path find_package(const std::string& name, const std::filesystem::path& near);

/// Returns the folders that packages export to Gazebo for models and media: `gazebo_model_path` and `gazebo_media_path`
/// of <gazebo_ros>, first those of the package around `near`, then those of all packages in ROS_PACKAGE_PATH.
std::vector<std::filesystem::path> exported_folders(const std::filesystem::path& near);

}  // namespace bubblesim
