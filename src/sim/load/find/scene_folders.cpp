// SPDX-License-Identifier: BSD-3-Clause
// Searches scenes.
#include "load/find/scene_folders.hpp"

#include <algorithm>
#include <cstdlib>
#include <set>
#include <sstream>

#include "bubblesim/error.hpp"
#include "bubblesim/nearest_names.hpp"
#include "bubblesim/scene_loader.hpp"
#include "files/library_folder.hpp"

namespace bubblesim {

namespace fs = std::filesystem;

namespace {

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/// The error for a file of another kind, with what to do; empty when the file may be a scene.
std::string no_scene(const fs::path& path) {
  const std::string name = path.filename().string();
  for (const char* script : {".py", ".lua"}) {
    if (!ends_with(name, script)) continue;
    return "is a script, not a scene: give the .sdf file whose model runs it, or assign it to a model of a scene with "
           "--child-script OBJECT=" +
           path.string();
  }
  for (const char* scene : {".simscene.xml", ".simmodel.xml"}) {
    if (!ends_with(name, scene)) continue;
    return "is a CoppeliaSim file in XML, which cannot be read: save it as .ttt or .ttm there";
  }
  return {};
}

/// Names files beside one that does not exist, of its kind, and the folder.
std::string similar_file(const fs::path& file) {
  const fs::path folder = fs::absolute(file).parent_path();
  std::vector<std::string> names;
  std::error_code no_folder;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, no_folder)) {
    if (entry.path().extension() == file.extension()) names.push_back(entry.path().filename());
  }
  if (no_folder) return ": there is no folder " + folder.string();
  return did_you_mean(file.filename().string(), names) + " (in " + folder.string() + ")";
}

}  // namespace

fs::path shared_folder(const std::string& name, const fs::path& source) {
  for (fs::path up = library_folder(); up.has_relative_path(); up = up.parent_path()) {
    fs::path installed = up / "share" / "bubblesim" / name;
    if (fs::is_directory(installed)) return installed;
  }
  return source;
}

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
  folders.push_back(shared_folder("scenes", BUBBLESIM_SOURCE_SCENES));
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
  if (const std::string problem = no_scene(path); !problem.empty()) throw SceneError({{name_or_path, 0, "", problem}});
  const std::set<fs::path> extensions = {".sdf", ".world", ".urdf", ".xacro", ".ttt", ".ttm"};
  if (path.has_parent_path() || extensions.count(path.extension()) > 0) {
    if (fs::is_regular_file(path)) return fs::absolute(path);
    if (fs::is_directory(path)) throw SceneError({{name_or_path, 0, "", "is a folder, not a scene"}});
    throw SceneError({{name_or_path, 0, "", "file not found" + similar_file(path)}});
  }
  std::string searched;
  for (const fs::path& folder : scene_folders()) {
    if (fs::path file = folder / (name_or_path + ".sdf"); fs::is_regular_file(file)) return file;
    searched += " " + folder.string();
  }
  throw SceneError({{"", 0, "",
                     "scene not found: '" + name_or_path + "'" + did_you_mean(name_or_path, scene_names()) +
                         " (searched in" + searched + "; the path of an .sdf file is also accepted)"}});
}

}  // namespace bubblesim
