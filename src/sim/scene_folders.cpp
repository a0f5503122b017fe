// SPDX-License-Identifier: BSD-3-Clause
// Where scenes are looked for.
#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <sstream>

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

std::vector<fs::path> scene_folders() {
  std::vector<fs::path> folders;
  if (const char* path = std::getenv("BUBBLESIM_SCENE_PATH")) {
    std::istringstream entries(path);
    for (std::string entry; std::getline(entries, entry, ':');) {
      if (!entry.empty()) folders.emplace_back(entry);
    }
  }
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

}  // namespace bubblesim
