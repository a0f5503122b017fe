// SPDX-License-Identifier: BSD-3-Clause
#include "model_folders.hpp"

#include <utility>

#include "bubblesim/scene_loader.hpp"
#include "scene_folders.hpp"

namespace bubblesim {
namespace {

namespace fs = std::filesystem;

constexpr const char* kModelScheme = "model://";
constexpr const char* kFileScheme = "file://";

std::string without(const std::string& scheme, const std::string& uri) {
  return uri.rfind(scheme, 0) == 0 ? uri.substr(scheme.size()) : uri;
}

}  // namespace

std::vector<fs::path> model_folders(const fs::path& scene_folder) {
  std::vector<fs::path> folders = {scene_folder, scene_folder / "models"};
  for (const char* variable : {"BUBBLESIM_MODEL_PATH", "GAZEBO_MODEL_PATH"}) {
    for (fs::path& folder : folders_of(variable)) folders.push_back(std::move(folder));
  }
  for (const fs::path& folder : scene_folders()) folders.push_back(folder / "models");
  return folders;
}

fs::path find_model(const std::string& uri, const fs::path& scene_folder) {
  const fs::path wanted = without(kFileScheme, without(kModelScheme, uri));
  for (const fs::path& folder : model_folders(scene_folder)) {
    if (fs::path found = folder / wanted; !wanted.empty() && fs::exists(found)) return found;  // absolute ones, too
  }
  return {};
}

}  // namespace bubblesim
