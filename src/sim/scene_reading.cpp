// SPDX-License-Identifier: BSD-3-Clause
#include "scene_reading.hpp"

#include <cstdio>
#include <utility>

#include "model_folders.hpp"

namespace bubblesim {

void SceneReading::report(const Source& source, const std::string& object, std::string message) {
  problems_.push_back({source.file, source.line, object, std::move(message)});
}

void SceneReading::warn(const Source& source, const std::string& object, std::string message) {
  const Problem problem{source.file, source.line, object, std::move(message)};
  std::fprintf(stderr, "warning: %s\n", problem.text().c_str());
}

void SceneReading::take(const sdf::Errors& errors, const std::string& object) {
  // Once a joint or frame names something that does not exist, nothing around it can be resolved: one error is enough.
  if (!object.empty() && frames_broken_) return;
  for (Problem& problem : xml_.located(errors, object)) {
    if (problem.message.rfind("Root object can only contain one model", 0) == 0) {
      warn({problem.file, problem.line}, "", "holds several models: the first one is taken");
      continue;
    }
    if (object.empty()) frames_broken_ = true;
    if (problem.message.rfind("Unable to find uri[", 0) == 0) problem.message += where_models_are();
    problems_.push_back(std::move(problem));
  }
}

std::string SceneReading::where_models_are() const {
  std::string folders;
  for (const std::filesystem::path& folder : model_folders(folder_)) folders += " " + folder.string();
  return " (searched in" + folders + "; BUBBLESIM_MODEL_PATH adds folders)";
}

}  // namespace bubblesim
