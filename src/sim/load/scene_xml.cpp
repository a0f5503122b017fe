// SPDX-License-Identifier: BSD-3-Clause
#include "load/scene_xml.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <regex>
#include <string_view>

#include "load/sdf_extensions.hpp"
#include "load/xml_fault.hpp"
#include "load/xml_lines.hpp"

namespace bubblesim {
namespace {

// SDFormat's name of a text without a file.
constexpr const char* kUnnamedText = "<data-string>";
constexpr const char* kUrdf = "<urdf-string>";

using Visitor = std::function<void(const tinyxml2::XMLElement&)>;

void visit(const tinyxml2::XMLElement& element, const Visitor& visitor) {
  visitor(element);
  for (const auto* child = element.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
    visit(*child, visitor);
  }
}

constexpr std::string_view kPlugin = "plugin";

/// The path from the root to an element, of tags and names: equal in the XML and in SDFormat's tree. For elements in a
/// plugin it starts at the plugin, so that it is also equal in URDF.
std::string place(const tinyxml2::XMLElement& element) {
  const auto* parent = element.Parent() != nullptr ? element.Parent()->ToElement() : nullptr;
  const char* name = element.Attribute("name");
  return (parent != nullptr && element.Name() != kPlugin ? place(*parent) : "") + "/" + element.Name() + ":" +
         (name != nullptr ? name : "");
}

std::string place(const sdf::ElementPtr& element) {
  const sdf::ElementPtr parent = element->GetParent();
  const std::string name = element->GetAttributeSet("name") ? element->GetAttribute("name")->GetAsString() : "";
  return (parent != nullptr && element->GetName() != kPlugin ? place(parent) : "") + "/" + element->GetName() + ":" +
         name;
}

/// SDFormat has no lines for elements that it does not know, nor for those of URDF.
bool needs_line(const std::string& name, const std::string& place) {
  return is_own_element(name) || place.rfind("/" + std::string(kPlugin) + ":", 0) == 0 ||
         place.find("mimic:/") != std::string::npos;
}

/// SDFormat repeats each error for every parent element and once more for the file.
bool only_follows(const std::string& message) {
  return message.rfind("Error reading element <", 0) == 0 || message.rfind("Unable to read file", 0) == 0 ||
         message.rfind("Unable to read SDF string", 0) == 0 || message.rfind("Failed to load a world", 0) == 0 ||
         message.find("Graph") != std::string::npos;
}

}  // namespace

SceneXml::SceneXml(const std::filesystem::path& file) : file_(file.string()) {
  std::ifstream stream(file);
  read({std::istreambuf_iterator<char>(stream), {}});
}

SceneXml::SceneXml(const std::string& text, std::string name) : file_(std::move(name)) { read(text); }

void SceneXml::read(const std::string& text) {
  const tinyxml2::XMLError result = document_.Parse(text.c_str(), text.size());
  if (result != tinyxml2::XML_SUCCESS) {
    if (result == tinyxml2::XML_ERROR_EMPTY_DOCUMENT) throw SceneError({{file_, 0, "", "is empty"}});
    const std::optional<XmlFault> fault = find_xml_fault(text);
    throw SceneError({{file_, fault ? fault->line : document_.ErrorLineNum(), "",
                       "is not well-formed XML: " + (fault ? fault->message : document_.ErrorName())}});
  }
  const tinyxml2::XMLElement* root = document_.RootElement();
  if (root == nullptr) throw SceneError({{file_, 0, "", "contains no XML element"}});
  const std::string name = root->Name();
  // <robot> is URDF, which SDFormat converts; <gazebo> is the name of <sdf> before version 1.3.
  if (name != "sdf" && name != "robot" && name != "gazebo") {
    throw SceneError({{file_, root->GetLineNum(), "",
                       "is not an SDFormat file: the root element is <" + name + ">, expected <sdf>"}});
  }
  if (name == "robot") return;
  static const std::regex wanted(R"(\d+\.\d+.*)");
  const char* version = root->Attribute("version");
  if (version == nullptr || !std::regex_match(version, wanted)) {
    throw SceneError(
        {{file_, root->GetLineNum(), "",
          version == nullptr ? "<" + name + "> has no version: use <" + name + " version=\"1.6\">"
                             : "invalid version '" + std::string(version) + "': expected a version such as 1.6"}});
  }
}

void SceneXml::place_elements(const sdf::ElementPtr& root) const {
  std::multimap<std::string, int> lines;
  visit(*document_.RootElement(), [&lines](const tinyxml2::XMLElement& element) {
    const std::string where = place(element);
    if (needs_line(element.Name(), where)) lines.emplace(where, element.GetLineNum());
  });
  const std::function<void(const sdf::ElementPtr&)> number = [&](const sdf::ElementPtr& element) {
    // SDFormat does not store the file name of a text, nor of converted URDF.
    const std::string& named = element->FilePath();
    if (named.empty() || named == kUnnamedText || named == kUrdf || named == "urdf file") {
      element->SetFilePath(file_);
    } else if (!originals_.empty()) {
      element->SetFilePath(original_of(named));
    }
    const std::string where = place(element);
    if (element->FilePath() == file_ && needs_line(element->GetName(), where)) {
      const auto found = lines.lower_bound(where);
      if (found != lines.end() && found->first == where) {
        element->SetLineNumber(found->second);
        lines.erase(found);
      }
    }
    for (auto child = element->GetFirstElement(); child != nullptr; child = child->GetNextElement()) number(child);
  };
  number(root);
}

Source SceneXml::place_of(const std::string& element, const std::string& text) const {
  Source source{file_, 0};
  visit(*document_.RootElement(), [&](const tinyxml2::XMLElement& found) {
    const std::string found_text = found.GetText() != nullptr ? found.GetText() : "";
    if (source.line == 0 && element == found.Name() && text == found_text) source.line = found.GetLineNum();
  });
  return source;
}

std::string SceneXml::object_at(const std::string& file, int line) const {
  std::string path;
  if (file != file_) return path;
  visit(*document_.RootElement(), [&](const tinyxml2::XMLElement& element) {
    if (element.GetLineNum() == line) path = object_path(element);
  });
  return path;
}

bool SceneXml::is_urdf() const { return std::string_view(document_.RootElement()->Name()) == "robot"; }

/// The error for an element that SDFormat could not read, without details from SDFormat.
std::string SceneXml::unusable_text(const std::string& element, int line) const {
  std::string text;
  visit(*document_.RootElement(), [&](const tinyxml2::XMLElement& found) {
    if (found.GetLineNum() == line && element == found.Name() && found.GetText() != nullptr) text = found.GetText();
  });
  return "<" + element + "> has the invalid value '" + text + "' (wrong type or out of range)";
}

/// The line of an object that a message calls `joint with name[j]` or `link named l`.
int SceneXml::line_of_named(const std::string& message) const {
  static const std::regex pattern(
      R"((model|link|joint|frame|sensor|collision) (?:with name ?\[([^\]]*)\]|named (\S+)))", std::regex::icase);
  for (std::sregex_iterator match(message.begin(), message.end(), pattern); match != std::sregex_iterator(); ++match) {
    std::string kind = match->str(1);
    kind[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(kind[0])));
    const std::string name = match->str(2) + match->str(3);
    int line = 0;
    visit(*document_.RootElement(), [&](const tinyxml2::XMLElement& element) {
      if (kind == element.Name() && element.Attribute("name", name.c_str()) != nullptr) line = element.GetLineNum();
    });
    if (line > 0) return line;
  }
  return 0;
}

/// The line of the element at the path /Model/joint.
int SceneXml::line_of_object(const std::string& path) const {
  int line = 0;
  visit(*document_.RootElement(), [&](const tinyxml2::XMLElement& element) {
    if (object_path(element) == path && line == 0) line = element.GetLineNum();
  });
  return line;
}

void SceneXml::stands_for(const std::filesystem::path& copy, const std::filesystem::path& original) {
  originals_[copy.string()] = original.string();
}

std::string SceneXml::original_of(const std::string& file) const {
  const auto found = originals_.find(file);
  return found != originals_.end() ? found->second : file;
}

std::string SceneXml::file_of(const sdf::Error& error) const {
  const std::string file = original_of(error.FilePath().value_or(kUnnamedText));
  return file == kUnnamedText || file == kUrdf ? file_ : file;
}

std::vector<Problem> SceneXml::located(const sdf::Errors& errors, const std::string& object) const {
  static const std::regex unread("Error reading element <(.*)>");
  std::vector<Problem> problems;
  bool harmless = false;
  for (const sdf::Error& error : errors) {
    if (only_follows(error.Message())) continue;
    // Errors that are reported elsewhere: unknown sensor types by the reader of the sensor, shapes with equal names by
    // the reader of the link. Many models have moments of inertia that no real body has. ODE can simulate them if they
    // are positive definite, which the scene check verifies.
    static const std::regex namesake("(collision|visual) with name ?\\[.*\\] already exists.*");
    // SdfRepairs reports scripts.
    if (error.Code() == sdf::ErrorCode::LINK_INERTIA_INVALID || std::regex_match(error.Message(), namesake) ||
        error.Message().rfind("A <script> element is missing a child", 0) == 0 ||
        error.Message().rfind("Attempting to load a Sensor, but the provided sensor type", 0) == 0) {
      harmless = true;
      continue;
    }
    int line = error.LineNumber().value_or(line_of_named(error.Message()));
    if (line == 0 && !object.empty()) line = line_of_object(object);
    // SDFormat reports the same problem in several ways: keep the first.
    const bool known = std::any_of(problems.begin(), problems.end(), [&](const Problem& problem) {
      return (line > 0 && problem.line == line) || problem.message == error.Message();
    });
    if (!known) problems.push_back({file_of(error), line, object, error.Message()});
  }
  if (!problems.empty() || errors.empty() || harmless) return problems;
  const sdf::Error& first = errors.front();
  const std::string file = file_of(first);
  const int line = first.LineNumber().value_or(object.empty() ? 0 : line_of_object(object));
  std::smatch match;
  const std::string message = first.Message();
  const bool is_unread = file == file_ && std::regex_match(message, match, unread);
  // This message repeats the whole text; SDFormat prints the cause, if it knows it, on stderr only.
  if (message.rfind("Unable to read SDF string", 0) == 0)
    return {{file, 0, "", "SDFormat cannot convert it to a model"}};
  return {{file, line, object, is_unread ? unusable_text(match.str(1), line) : message}};
}

}  // namespace bubblesim
