// SPDX-License-Identifier: BSD-3-Clause
// Where ROS packages lie, found as rospack does but without it: the core knows no ROS.
#pragma once

#include <filesystem>
#include <string>

namespace bubblesim {

/// The folder of a package: around `near`, below those in ROS_PACKAGE_PATH, or in share/ of those in CMAKE_PREFIX_PATH.
/// Nothing when there is none.
std::filesystem::path find_package(const std::string& name, const std::filesystem::path& near);

}  // namespace bubblesim
