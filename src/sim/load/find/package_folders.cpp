// SPDX-License-Identifier: BSD-3-Clause
#include "load/find/package_folders.hpp"

#include <tinyxml2.h>

#include <chrono>
#include <mutex>
#include <sstream>
#include <utility>

#include "load/find/scene_folders.hpp"

namespace bubblesim {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxDepth = 6;  // of packages below a folder of ROS_PACKAGE_PATH
constexpr const char* kManifest = "package.xml";

bool is_package(const fs::path& folder, const std::string& name) {
  tinyxml2::XMLDocument manifest;
  std::error_code unreadable;
  if (!fs::is_regular_file(folder / kManifest, unreadable)) return false;  // reading a FIFO would block
  if (manifest.LoadFile((folder / kManifest).c_str()) != tinyxml2::XML_SUCCESS) return false;
  const auto* package = manifest.FirstChildElement("package");
  const auto* element = package != nullptr ? package->FirstChildElement("name") : nullptr;
  return element != nullptr && element->GetText() != nullptr && element->GetText() == name;
}

/// Packages do not contain packages, and CATKIN_IGNORE excludes a folder.
fs::path find_below(const fs::path& folder, const std::string& name, int depth) {
  std::error_code unreadable;
  if (fs::exists(folder / kManifest, unreadable)) return is_package(folder, name) ? folder : fs::path();
  if (depth == 0 || fs::exists(folder / "CATKIN_IGNORE", unreadable)) return {};
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, unreadable)) {
    if (!entry.is_directory(unreadable) || entry.path().filename().string().front() == '.') continue;
    if (fs::path found = find_below(entry.path(), name, depth - 1); !found.empty()) return found;
  }
  return {};
}

/// Adds folders of the form `${prefix}/models:${prefix}/more`, where ${prefix} is the package's folder.
void add_folders(const fs::path& package, std::string path, std::vector<fs::path>& folders) {
  const std::string prefix = "${prefix}";
  for (std::size_t place = path.find(prefix); place != std::string::npos; place = path.find(prefix, place)) {
    path.replace(place, prefix.size(), package.string());
  }
  std::istringstream entries(path);
  for (std::string entry; std::getline(entries, entry, ':');) {
    if (!entry.empty()) folders.push_back(fs::path(entry).lexically_normal());
  }
}

void add_exports(const fs::path& package, std::vector<fs::path>& folders) {
  tinyxml2::XMLDocument manifest;
  if (manifest.LoadFile((package / kManifest).c_str()) != tinyxml2::XML_SUCCESS) return;
  const auto* root = manifest.FirstChildElement("package");
  const auto* exports = root != nullptr ? root->FirstChildElement("export") : nullptr;
  const auto* element = exports != nullptr ? exports->FirstChildElement("gazebo_ros") : nullptr;
  for (; element != nullptr; element = element->NextSiblingElement("gazebo_ros")) {
    for (const char* name : {"gazebo_model_path", "gazebo_media_path"}) {
      if (const char* path = element->Attribute(name)) add_folders(package, path, folders);
    }
  }
}

void add_exports_below(const fs::path& folder, int depth, std::vector<fs::path>& folders) {
  std::error_code unreadable;
  if (fs::exists(folder / kManifest, unreadable)) return add_exports(folder, folders);
  if (depth == 0 || fs::exists(folder / "CATKIN_IGNORE", unreadable)) return;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, unreadable)) {
    if (!entry.is_directory(unreadable) || entry.path().filename().string().front() == '.') continue;
    add_exports_below(entry.path(), depth - 1, folders);
  }
}

/// Cached for a while, because it searches all packages and each model of a scene calls it.
std::vector<fs::path> exported_by_all() {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::seconds kValid{2};
  static std::mutex mutex;
  static std::vector<fs::path> known;
  static std::vector<fs::path> known_roots;
  static Clock::time_point known_since;
  const std::vector<fs::path> roots = folders_of("ROS_PACKAGE_PATH");
  const std::scoped_lock lock(mutex);
  if (roots == known_roots && Clock::now() - known_since < kValid) return known;
  known.clear();
  for (const fs::path& root : roots) {
    // In share/ of an install space, packages are direct subfolders, among many other folders.
    add_exports_below(root, root.filename() == "share" ? 1 : kMaxDepth, known);
  }
  known_roots = roots;
  known_since = Clock::now();
  return known;
}

}  // namespace

std::vector<fs::path> exported_folders(const fs::path& near) {
  std::vector<fs::path> folders;
  for (fs::path up = near; up.has_relative_path(); up = up.parent_path()) add_exports(up, folders);
  for (fs::path& folder : exported_by_all()) folders.push_back(std::move(folder));
  return folders;
}

fs::path find_package(const std::string& name, const fs::path& near) {
  for (fs::path up = near; up.has_relative_path(); up = up.parent_path()) {
    if (is_package(up, name)) return up;
  }
  const std::vector<fs::path> roots = folders_of("ROS_PACKAGE_PATH");
  for (const fs::path& root : roots) {  // most packages are in a folder with their name
    if (is_package(root / name, name)) return root / name;
  }
  for (const fs::path& root : roots) {
    if (fs::path found = find_below(root, name, kMaxDepth); !found.empty()) return found;
  }
  for (const fs::path& prefix : folders_of("CMAKE_PREFIX_PATH")) {
    if (is_package(prefix / "share" / name, name)) return prefix / "share" / name;
  }
  return {};
}

}  // namespace bubblesim
