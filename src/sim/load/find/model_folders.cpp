// SPDX-License-Identifier: BSD-3-Clause
#include "load/find/model_folders.hpp"

#include <algorithm>
#include <cctype>
#include <optional>
#include <regex>
#include <utility>

#include "bubblesim/scene_loader.hpp"
#include "load/find/package_folders.hpp"
#include "load/find/scene_folders.hpp"

namespace bubblesim {
namespace {

namespace fs = std::filesystem;

/// The rest of a URI after `scheme`, if it starts with `scheme`.
std::optional<fs::path> after(const std::string& scheme, const std::string& uri) {
  if (uri.rfind(scheme, 0) != 0) return std::nullopt;
  // Some files have model:///NAME; file:///path is absolute.
  const std::size_t start = scheme == "model://" ? uri.find_first_not_of('/', scheme.size()) : scheme.size();
  return uri.substr(std::min(start, uri.size()));
}

fs::path without_first(const fs::path& path) {
  fs::path rest;
  for (auto part = path.begin(); part != path.end(); ++part) {
    if (part != path.begin()) rest /= *part;
  }
  return rest;
}

fs::path find_in(const std::vector<fs::path>& folders, const fs::path& wanted) {
  for (const fs::path& folder : folders) {
    if (fs::path found = folder / wanted; !wanted.empty() && fs::exists(found)) return found;  // also absolute paths
  }
  return {};
}

fs::path find_in_package(const fs::path& name_and_rest, const fs::path& near) {
  if (name_and_rest.empty()) return {};
  const fs::path package = find_package(name_and_rest.begin()->string(), near);
  return package.empty() ? fs::path() : find_in({package}, without_first(name_and_rest));
}

/// NAME or NAME/PATH of https://HOST/1.0/OWNER/models/NAME[/VERSION[/files/PATH]], the URIs of models on a server in
/// gz-sim's worlds. Empty for other URIs.
std::optional<fs::path> of_server(const std::string& uri) {
  if (!after("https://", uri) && !after("http://", uri)) return std::nullopt;
  static const std::regex pattern("https?://.*/models/([^/]+)(/[^/]+/files/(.+)|/[^/]*)?/?");
  std::smatch match;
  if (!std::regex_match(uri, match, pattern)) return std::nullopt;
  const std::string name = std::regex_replace(match.str(1), std::regex("%20"), " ");
  return match.str(3).empty() ? fs::path(name) : fs::path(name) / match.str(3);
}

/// `Ground Plane` as the usual folder name: ground_plane.
fs::path as_folder(const fs::path& path) {
  std::string name = path.begin()->string();
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char character) {
    return character == ' ' ? '_' : static_cast<char>(std::tolower(character));
  });
  const fs::path rest = without_first(path);
  return rest.empty() ? fs::path(name) : name / rest;
}

/// Replaces $(find NAME), known from roslaunch and xacro, by the package's folder. Unknown packages are not replaced.
std::string with_packages(std::string uri, const fs::path& near) {
  const std::string start = "$(find ";
  const std::size_t open = uri.find(start);
  const std::size_t close = uri.find(')', std::min(open, uri.size()));
  if (open == std::string::npos || close == std::string::npos) return uri;
  const std::size_t name = open + start.size();
  const fs::path package = find_package(uri.substr(name, close - name), near);
  return package.empty() ? uri : uri.replace(open, close + 1 - open, package.string());
}

}  // namespace

std::vector<fs::path> model_folders(const fs::path& scene_folder) {
  std::vector<fs::path> folders = {scene_folder, scene_folder / "models"};
  for (const char* variable : {"BUBBLESIM_MODEL_PATH", "GAZEBO_MODEL_PATH", "GAZEBO_RESOURCE_PATH",
                               "GZ_SIM_RESOURCE_PATH", "IGN_GAZEBO_RESOURCE_PATH"}) {
    for (fs::path& folder : folders_of(variable)) folders.push_back(std::move(folder));
  }
  folders.push_back(scene_folder.parent_path());
  for (fs::path& folder : exported_folders(scene_folder)) folders.push_back(std::move(folder));
  for (const fs::path& folder : scene_folders()) folders.push_back(folder / "models");
  return folders;
}

fs::path find_model(const std::string& given, const fs::path& scene_folder) {
  const std::string uri = with_packages(given, scene_folder);
  if (const auto path = of_server(uri)) {
    const fs::path found = find_in(model_folders(scene_folder), *path);
    return found.empty() ? find_in(model_folders(scene_folder), as_folder(*path)) : found;
  }
  if (const auto path = after("file://", uri)) return find_in(model_folders(scene_folder), *path);
  // Gazebo takes a package as a model and the other way round: SDFormat converts package:// in a URDF file to model://.
  const auto of_package = after("package://", uri);
  if (of_package) {
    if (fs::path found = find_in_package(*of_package, scene_folder); !found.empty()) return found;
  }
  const auto of_model = after("model://", uri);
  const fs::path searched = of_package ? *of_package : of_model ? *of_model : fs::path(uri);
  const fs::path found = find_in(model_folders(scene_folder), searched);
  return found.empty() && of_model ? find_in_package(*of_model, scene_folder) : found;
}

fs::path find_resource(const std::string& uri, const fs::path& naming_file, const fs::path& scene_folder) {
  const fs::path beside = fs::exists(naming_file) ? naming_file.parent_path() : scene_folder;
  auto of_model = after("model://", uri);
  if (!of_model) of_model = after("package://", uri);
  if (!of_model) {
    if (fs::path found = find_in({beside}, after("file://", uri).value_or(uri)); !found.empty()) return found;
    return find_model(uri, scene_folder);
  }
  if (fs::path found = find_model(uri, scene_folder); !found.empty()) return found;
  if (fs::path found = find_in({beside.parent_path()}, *of_model); !found.empty()) return found;
  return find_in({beside}, without_first(*of_model));
}

}  // namespace bubblesim
