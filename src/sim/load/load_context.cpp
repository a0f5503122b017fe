// SPDX-License-Identifier: BSD-3-Clause
#include "load/load_context.hpp"

#include <optional>
#include <regex>
#include <utility>

#include "load/find/model_folders.hpp"

namespace bubblesim {

void LoadContext::report(const Source& source, const std::string& object, std::string message) {
  problems_.push_back({source.file, source.line, object, std::move(message)});
}

void LoadContext::warn(const Source& source, const std::string& object, std::string message) {
  warnings_.push_back({source.file, source.line, object, std::move(message)});
}

namespace {

/// SDFormat keeps unknown elements; they have no effect. Returns the warning if the message is about one.
std::optional<std::string> about_unknown_element(const std::string& message) {
  static const std::regex pattern(R"(XML Element\[([^\]]*)\], child of element\[([^\]]*)\], not defined in SDF.*)");
  std::smatch match;
  if (!std::regex_search(message, match, pattern)) return std::nullopt;
  return "<" + match.str(1) + "> is not an element of <" + match.str(2) + ">: ignored";
}

/// Values without an effect here, or for which SDFormat uses its default.
bool is_of_no_effect(const std::string& message) {
  static const std::regex pattern(
      R"((Camera sensor <image><format> has invalid value|The value\[.*\] for a <shader><type>|Unknown atmosphere type|)"
      R"(The supplied <surface_model>|Invalid light type with a value).*)");
  return std::regex_match(message, pattern);
}

/// Elements of later versions of SDFormat or of gz-sim, which the readers support.
bool is_of_later_version(const std::string& message) {
  static const std::regex pattern(
      R"(XML Element\[(mimic\], child of element\[axis|screw_thread_pitch\], child of element\[joint\])"
      R"(|(gz_frame_id|ignition_frame_id|frame_id)\], child of element\[sensor\])"
      R"(|(camera_info_topic|optical_frame_id)\], child of element\[camera\]))");
  return std::regex_search(message, pattern);
}

}  // namespace

void LoadContext::take(const sdf::Errors& errors, const std::string& object) {
  // When a joint or frame refers to an object that does not exist, nothing around it can be resolved: one error is
  // enough.
  if (!object.empty() && frames_broken_) return;
  for (Problem& problem : xml_.located(errors, object)) {
    if (problem.message.rfind("Root object can only contain one model", 0) == 0) {
      warn({problem.file, problem.line}, "", "contains several models: the first one is used");
      continue;
    }
    if (problem.message.rfind("light with name[", 0) == 0) {
      warn({problem.file, problem.line}, "", problem.message + " The second one is ignored.");
      continue;
    }
    if (is_of_later_version(problem.message)) continue;
    if (is_of_no_effect(problem.message)) {
      warn({problem.file, problem.line}, problem.object, problem.message);
      continue;
    }
    if (const auto unknown = about_unknown_element(problem.message)) {
      if (problem.object.empty()) problem.object = xml_.object_at(problem.file, problem.line);
      warn({problem.file, problem.line}, problem.object, *unknown);
      continue;
    }
    if (object.empty()) frames_broken_ = true;
    if (problem.message.rfind("Unable to find uri[", 0) == 0) problem.message += where_models_are();
    problems_.push_back(std::move(problem));
  }
}

std::string LoadContext::where_models_are() const {
  std::string folders;
  for (const std::filesystem::path& folder : model_folders(folder_)) folders += " " + folder.string();
  return " (searched in" + folders + "; BUBBLESIM_MODEL_PATH adds folders)";
}

}  // namespace bubblesim
