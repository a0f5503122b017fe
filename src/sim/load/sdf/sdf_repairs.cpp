// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/sdf_repairs.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sdf/SDFImpl.hh>
#include <sdf/parser.hh>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "load/find/model_folders.hpp"
#include "load/sdf/sdf_values.hpp"
#include "load/sdf_extensions.hpp"
#include "load/xml_lines.hpp"

namespace bubblesim {
namespace {

namespace fs = std::filesystem;
using tinyxml2::XMLElement;

constexpr const char* kSeparator = "::";

std::string text_of(const XMLElement* element) {
  const std::string text = element != nullptr && element->GetText() != nullptr ? element->GetText() : "";
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

std::string child_text(const XMLElement& parent, const char* name) { return text_of(parent.FirstChildElement(name)); }

std::string attribute(const XMLElement& element, const char* name) {
  const char* value = element.Attribute(name);
  return value != nullptr ? value : "";
}

bool is(const XMLElement& element, std::string_view name) { return name == element.Name(); }

/// The frames whose names have the longest common suffix with `wanted`.
std::vector<std::string> ending_as(const std::set<std::string>& frames, const std::string& wanted) {
  for (std::string end = wanted;;) {
    std::vector<std::string> found;
    for (const std::string& frame : frames) {
      const bool ends = frame.size() > end.size() + 2 &&
                        frame.compare(frame.size() - end.size() - 2, std::string::npos, kSeparator + end) == 0;
      if (frame == end || ends) found.push_back(frame);
    }
    const std::size_t scope = end.find(kSeparator);
    if (!found.empty() || scope == std::string::npos) return found;
    end = end.substr(scope + 2);
  }
}

}  // namespace

void SdfRepairs::warn(const std::string& file, const XMLElement& element, const std::string& message) {
  reading_.warn({file, element.GetLineNum()}, object_path(element), message);
}

SdfRepairs::~SdfRepairs() {
  std::error_code ignored;
  if (!folder_.empty()) fs::remove_all(folder_, ignored);
}

std::optional<std::string> SdfRepairs::repaired_scene() {
  tinyxml2::XMLDocument& document = reading_.xml().document();
  XMLElement& root = *document.RootElement();
  const bool is_old = is(root, "gazebo");  // the name of <sdf> before version 1.3
  if (is_old) root.SetName("sdf");
  if (!repair(root, reading_.xml().file()) && !is_old) return std::nullopt;
  return print_in_lines(document);
}

bool SdfRepairs::repair(XMLElement& sdf, const std::string& file) {
  const bool has_bad_values = replace_bad_values(sdf, file, reading_);
  return repair_below(sdf, file) || has_bad_values;
}

bool SdfRepairs::repair_below(XMLElement& parent, const std::string& file) {
  bool changed = is(parent, "world") && leave_out_missing(parent, file);
  for (auto* child = parent.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
    const std::string_view kind = child->Name();
    if (kind == "plugin" || is_own_element(child->Name())) continue;
    changed = repair_below(*child, file) || changed;
    if (kind == "script" && is(parent, "material")) changed = repair_script(*child, file) || changed;
    if (kind == "uri") changed = repair_uri(*child, file) || changed;
    if (kind != "include") continue;
    const Included* found = included(*child);
    if (found == nullptr || !found->is_changed) continue;
    child->FirstChildElement("uri")->SetText(found->file.c_str());
    changed = true;
  }
  if (is(parent, "world") || is(parent, "model")) changed = number_models(parent, file) || changed;
  if (is(parent, "model")) changed = repair_joints(parent, file) || changed;
  return changed;
}

/// Old files have the material's name as text, and Gazebo's own materials without their file.
bool SdfRepairs::repair_script(XMLElement& script, const std::string& file) {
  const std::string text = text_of(&script);
  std::string name = child_text(script, "name");
  const bool changes = name.empty() && !text.empty();
  if (changes) {
    name = text;
    script.DeleteChildren();
    script.InsertNewChildElement("name")->SetText(name.c_str());
  }
  if (name.empty()) {
    warn(file, script, "<script> has no <name>: no material");
  } else if (changes) {
    warn(file, script, "<script> has text and no <name>: '" + name + "' is used as the material's name");
  } else if (child_text(script, "uri").empty()) {
    warn(file, script, "<script> has no <uri>: '" + name + "' is searched in Gazebo's materials");
  }
  return changes;
}

bool SdfRepairs::repair_uri(XMLElement& uri, const std::string& file) {
  const std::string scheme = "model://";
  const std::string text = text_of(&uri);
  if (text.rfind(scheme + "/", 0) != 0) return false;
  const std::string fixed = scheme + text.substr(std::min(text.find_first_not_of('/', scheme.size()), text.size()));
  warn(file, uri, "<uri> is '" + text + "': using " + fixed);
  uri.SetText(fixed.c_str());
  return true;
}

/// A world is loaded without the models that are not found; a model needs its parts.
bool SdfRepairs::leave_out_missing(XMLElement& world, const std::string& file) {
  bool changed = false;
  for (auto* include = world.FirstChildElement("include"); include != nullptr;) {
    auto* next = include->NextSiblingElement("include");
    const std::string uri = child_text(*include, "uri");
    if (!uri.empty() && find_model(uri, reading_.folder()).empty() && sdf::findFile(uri, true, false).empty()) {
      warn(file, *include, "model not found: '" + uri + "', ignored" + reading_.where_models_are());
      world.DeleteChild(include);
      changed = true;
    }
    include = next;
  }
  return changed;
}

/// SDFormat rejects models with equal names.
bool SdfRepairs::number_models(XMLElement& parent, const std::string& file) {
  std::vector<std::pair<XMLElement*, std::string>> models;
  std::set<std::string> taken;
  for (auto* child = parent.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
    if (!is(*child, "model") && !is(*child, "include")) continue;
    std::string name = is(*child, "model") ? attribute(*child, "name") : name_of(*child);
    if (name.empty()) continue;
    taken.insert(name);
    models.emplace_back(child, std::move(name));
  }
  std::set<std::string> seen;
  std::map<std::string, int> last;
  for (const auto& [model, name] : models) {
    if (seen.insert(name).second) continue;
    int& number = last.try_emplace(name, 1).first->second;
    std::string numbered;
    do {
      numbered = name + "_" + std::to_string(++number);
    } while (!taken.insert(numbered).second);
    if (is(*model, "model")) {
      model->SetAttribute("name", numbered.c_str());
    } else {
      auto* element = model->FirstChildElement("name");
      (element != nullptr ? element : model->InsertNewChildElement("name"))->SetText(numbered.c_str());
    }
    reading_.warn({file, model->GetLineNum()}, object_path(parent) + "/" + numbered,
                  "renamed: another model has the name '" + name + "'");
  }
  return seen.size() < models.size();
}

/// Gazebo finds the links of nested models under names that SDFormat rejects.
bool SdfRepairs::repair_joints(XMLElement& model, const std::string& file) {
  bool changed = false;
  std::optional<std::set<std::string>> frames;
  for (auto* joint = model.FirstChildElement("joint"); joint != nullptr; joint = joint->NextSiblingElement("joint")) {
    for (const char* end : {"parent", "child"}) {
      auto* element = joint->FirstChildElement(end);
      const std::string name = text_of(element);
      if (name.empty() || name == "world") continue;
      if (!frames) frames = frames_in(model);
      if (frames->count(name) > 0 || name == "__model__") continue;
      const std::vector<std::string> meant = ending_as(*frames, name);
      if (meant.size() != 1) continue;  // SDFormat reports it
      warn(file, *joint, "the " + std::string(end) + " '" + name + "' is not found: using " + meant.front());
      element->SetText(meant.front().c_str());
      changed = true;
    }
  }
  return changed;
}

std::string SdfRepairs::name_of(const XMLElement& include) {
  const std::string given = child_text(include, "name");
  if (!given.empty()) return given;
  const Included* found = included(include);
  return found != nullptr ? found->name : "";
}

std::set<std::string> SdfRepairs::frames_in(const XMLElement& model) {
  std::set<std::string> frames;
  const auto add_inner = [&frames](const std::string& name, const std::set<std::string>& inner, bool is_merged) {
    for (const std::string& frame : inner) frames.insert(is_merged ? frame : name + kSeparator + frame);
    if (!is_merged) frames.insert(name);
  };
  for (const auto* child = model.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
    const std::string_view kind = child->Name();
    if (kind == "link" || kind == "joint" || kind == "frame") frames.insert(attribute(*child, "name"));
    if (kind == "model") add_inner(attribute(*child, "name"), frames_in(*child), false);
    if (kind != "include") continue;
    const Included* found = included(*child);
    if (found != nullptr) add_inner(name_of(*child), found->frames, child->BoolAttribute("merge"));
  }
  return frames;
}

const SdfRepairs::Included* SdfRepairs::included(const XMLElement& include) {
  const std::string uri = child_text(include, "uri");
  if (uri.empty()) return nullptr;
  fs::path file = find_model(uri, reading_.folder());
  std::error_code unreadable;
  if (fs::is_directory(file, unreadable)) file = sdf::getModelFilePath(file.string());
  if (!fs::is_regular_file(file, unreadable)) return nullptr;
  const auto [entry, is_new] =
      included_.try_emplace(file);  // a file that includes itself finds the frames known so far
  if (is_new) read_included(file, entry->second);
  return &entry->second;
}

void SdfRepairs::read_included(const fs::path& file, Included& included) {
  included.file = file;
  std::ifstream stream(file);
  const std::string original{std::istreambuf_iterator<char>(stream), {}};
  const std::string text = without_late_declaration(original);
  tinyxml2::XMLDocument document;
  if (document.Parse(text.c_str(), text.size()) != tinyxml2::XML_SUCCESS) return;  // SDFormat reports it
  XMLElement* root = document.RootElement();
  const bool is_sdf = root != nullptr && is(*root, "sdf");
  const bool is_changed = is_sdf && repair(*root, file.string());
  if (is_changed || text != original) {
    included.is_changed = true;
    included.file = keep(file, is_changed ? print_in_lines(document) : text);
  }
  const XMLElement* model = is_sdf ? root->FirstChildElement("model") : nullptr;
  if (model == nullptr) return;
  included.name = attribute(*model, "name");
  included.frames = frames_in(*model);
}

fs::path SdfRepairs::keep(const fs::path& original, const std::string& text) {
  if (folder_.empty()) {
    std::string name = (fs::temp_directory_path() / "bubblesim-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
      throw SceneError({{original.string(), 0, "",
                         "cannot create a folder for its repaired copy in " + fs::temp_directory_path().string()}});
    folder_ = name;
  }
  const fs::path folder = folder_ / std::to_string(included_.size());
  fs::create_directories(folder);
  fs::path file = folder / original.filename();
  std::ofstream(file) << text;
  reading_.xml().stands_for(file, original);
  return file;
}

}  // namespace bubblesim
