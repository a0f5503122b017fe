// SPDX-License-Identifier: BSD-3-Clause
// The folder of ROS's files where the home cannot be written, as on a live system or a cluster.
#pragma once

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

namespace bubblesim {

/// Lets ROS write to a temporary folder, one for each user, if it cannot write to ~/.ros: sets ROS_HOME, for this
/// process and those that it starts, and prints that to stderr. Returns the folder, or an empty string where nothing is
/// to be changed. roscore and roscpp end otherwise.
inline std::string use_writable_ros_home() {
  const auto is_set = [](const char* name) { return std::getenv(name) != nullptr && *std::getenv(name) != '\0'; };
  if (is_set("ROS_HOME") || !is_set("HOME")) return {};
  const std::filesystem::path home = std::filesystem::path(std::getenv("HOME")) / ".ros";
  std::error_code error;
  std::filesystem::create_directories(home, error);
  if (access(home.c_str(), W_OK | X_OK) == 0) return {};
  const std::string why = error ? error.message() : std::generic_category().message(errno);
  const std::filesystem::path parent = std::filesystem::temp_directory_path(error);
  std::string folder = parent / ("bubblesim-ros-" + std::to_string(geteuid()));
  mkdir(folder.c_str(), S_IRWXU);
  struct stat found {};
  const bool is_own = lstat(folder.c_str(), &found) == 0 && S_ISDIR(found.st_mode) && found.st_uid == geteuid() &&
                      (found.st_mode & (S_IRWXG | S_IRWXO)) == 0;
  if (!is_own) {  // another user took the name
    folder += "-XXXXXX";
    if (mkdtemp(folder.data()) == nullptr) return {};
  }
  setenv("ROS_HOME", folder.c_str(), 1);
  std::fprintf(stderr, "info: %s cannot be written (%s): ROS keeps its files in %s\n", home.c_str(), why.c_str(),
               folder.c_str());
  return folder;
}

}  // namespace bubblesim
