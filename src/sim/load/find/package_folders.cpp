// SPDX-License-Identifier: BSD-3-Clause
#include "load/find/package_folders.hpp"

#include <chrono>
#include <mutex>
#include <optional>
#include <sstream>
#include <utility>

#include "files/file_text.hpp"
#include "load/find/scene_folders.hpp"
#include "load/xml/xml_parser.hpp"

namespace bubblesim {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxDepth = 6;  // of packages below a folder of ROS_PACKAGE_PATH
constexpr const char* kManifest = "package.xml";

/// The <package> of a manifest; empty when there is none that can be read.
std::optional<XmlElement> read_manifest(const fs::path& folder) {
  const fs::path file = folder / kManifest;
  std::error_code unreadable;
  if (!fs::is_regular_file(file, unreadable)) return std::nullopt;  // reading a FIFO would block
  std::vector<Problem> unused;
  try {
    XmlElement root = parse_xml(read_text(file), file.string(), unused);
    if (root.name == "package") return root;
  } catch (const SceneError&) {
    return std::nullopt;
  }
  return std::nullopt;
}

bool is_package(const fs::path& folder, const std::string& name) {
  const std::optional<XmlElement> package = read_manifest(folder);
  return package && package->child_text("name") == name;
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

void add_exports(const fs::path& folder, std::vector<fs::path>& folders) {
  const std::optional<XmlElement> package = read_manifest(folder);
  const XmlElement* exports = package ? package->child("export") : nullptr;
  if (exports == nullptr) return;
  for (const XmlElement& element : exports->children) {
    if (element.name != "gazebo_ros") continue;
    for (const char* name : {"gazebo_model_path", "gazebo_media_path"}) {
      if (const std::string* path = element.attribute(name)) add_folders(folder, *path, folders);
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
