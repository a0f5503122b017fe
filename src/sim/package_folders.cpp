// SPDX-License-Identifier: BSD-3-Clause
#include "package_folders.hpp"

#include <tinyxml2.h>

#include "scene_folders.hpp"

namespace bubblesim {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxDepth = 6;  // of packages below a folder of ROS_PACKAGE_PATH
constexpr const char* kManifest = "package.xml";

bool is_package(const fs::path& folder, const std::string& name) {
  tinyxml2::XMLDocument manifest;
  if (manifest.LoadFile((folder / kManifest).c_str()) != tinyxml2::XML_SUCCESS) return false;
  const auto* package = manifest.FirstChildElement("package");
  const auto* element = package != nullptr ? package->FirstChildElement("name") : nullptr;
  return element != nullptr && element->GetText() != nullptr && element->GetText() == name;
}

/// Packages hold no packages, and CATKIN_IGNORE hides what lies in a folder.
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

}  // namespace

fs::path find_package(const std::string& name, const fs::path& near) {
  for (fs::path up = near; up.has_relative_path(); up = up.parent_path()) {
    if (is_package(up, name)) return up;
  }
  const std::vector<fs::path> roots = folders_of("ROS_PACKAGE_PATH");
  for (const fs::path& root : roots) {  // most packages lie in a folder of their name
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
