// SPDX-License-Identifier: BSD-3-Clause
#include "load/load_context.hpp"

#include <utility>

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

std::string LoadContext::where_models_are() const {
  std::string folders;
  for (const std::filesystem::path& folder : model_folders(folder_)) folders += " " + folder.string();
  return " (searched in" + folders + "; BUBBLESIM_MODEL_PATH adds folders)";
}

}  // namespace bubblesim
