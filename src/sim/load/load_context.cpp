// SPDX-License-Identifier: BSD-3-Clause
#include "load/load_context.hpp"

#include <set>
#include <system_error>
#include <utility>

#include "bubblesim/nearest_names.hpp"
#include "load/find/model_folders.hpp"

namespace bubblesim {

std::filesystem::path LoadContext::folder_of(const Source& source) const {
  if (source.file.empty() || source.file == file_) return folder_;
  return std::filesystem::path(source.file).parent_path();
}

void LoadContext::report(const Source& source, const std::string& object, std::string message) {
  problems_.push_back({source.file, source.line, object, std::move(message)});
}

void LoadContext::warn(const Source& source, const std::string& object, std::string message) {
  warnings_.push_back({source.file, source.line, object, std::move(message)});
}

std::string LoadContext::where_models_are(const std::string& uri) const {
  std::string folders;
  std::set<std::string> models;
  for (const std::filesystem::path& folder : model_folders(folder_)) {
    folders += " " + folder.string();
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
      if (std::filesystem::exists(entry.path() / "model.config", ignored)) models.insert(entry.path().filename());
    }
  }
  return did_you_mean(std::filesystem::path(uri).filename().string(), {models.begin(), models.end()}) +
         " (searched in" + folders + "; BUBBLESIM_MODEL_PATH adds folders)";
}

}  // namespace bubblesim
