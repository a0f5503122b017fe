// SPDX-License-Identifier: BSD-3-Clause
// Where scenes are looked for.
#include "scene_folders.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <sstream>

#include "bubblesim/error.hpp"
#include "bubblesim/nearest_names.hpp"
#include "bubblesim/scene_loader.hpp"

namespace bubblesim {
namespace {

namespace fs = std::filesystem;

/// The folder that this library was loaded from.
fs::path library_folder() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<void*>(&scene_folders), &info) == 0 || info.dli_fname == nullptr) return {};
  return fs::absolute(info.dli_fname).parent_path();
}

}  // namespace

std::vector<fs::path> folders_of(const char* variable) {
  std::vector<fs::path> folders;
  const char* path = std::getenv(variable);
  std::istringstream entries(path != nullptr ? path : "");
  for (std::string entry; std::getline(entries, entry, ':');) {
    if (!entry.empty()) folders.emplace_back(entry);
  }
  return folders;
}

std::vector<fs::path> scene_folders() {
  std::vector<fs::path> folders = folders_of("BUBBLESIM_SCENE_PATH");
  // In an install space the scenes lie in share/; in a development space they are still in the source tree.
  for (fs::path up = library_folder(); up.has_relative_path(); up = up.parent_path()) {
    const fs::path installed = up / "share" / "bubblesim" / "scenes";
    if (fs::is_directory(installed)) {
      folders.push_back(installed);
      return folders;
    }
  }
  folders.emplace_back(BUBBLESIM_SOURCE_SCENES);
  return folders;
}

std::vector<std::string> scene_names() {
  std::set<std::string> names;
  for (const fs::path& folder : scene_folders()) {
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
      if (entry.path().extension() == ".sdf") names.insert(entry.path().stem().string());
    }
  }
  return {names.begin(), names.end()};
}

fs::path find_scene(const std::string& name_or_path) {
  const fs::path path(name_or_path);
  const std::set<fs::path> extensions = {".sdf", ".world", ".urdf", ".xacro"};
  if (path.has_parent_path() || extensions.count(path.extension()) > 0) {
    if (fs::is_regular_file(path)) return fs::absolute(path);
    throw SceneError({{name_or_path, 0, "", fs::is_directory(path) ? "is a folder, not a scene" : "no such file"}});
  }
  std::string searched;
  for (const fs::path& folder : scene_folders()) {
    if (fs::path file = folder / (name_or_path + ".sdf"); fs::is_regular_file(file)) return file;
    searched += " " + folder.string();
  }
  throw SceneError({{"", 0, "",
                     "no scene is named '" + name_or_path + "'" + did_you_mean(name_or_path, scene_names()) +
                         " (searched in" + searched + "; a path to an .sdf file works too)"}});
}

}  // namespace bubblesim
