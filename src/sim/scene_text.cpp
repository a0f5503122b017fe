// SPDX-License-Identifier: BSD-3-Clause
#include "scene_text.hpp"

#include <tinyxml2.h>

#include <fstream>
#include <iterator>

#include "xacro.hpp"

namespace bubblesim {
namespace {

/// Keeps lines as they are, unlike writing the XML anew.
void rename_root(std::string& text, const std::string& from, const std::string& to) {
  const std::size_t opening = text.find("<" + from);
  if (opening != std::string::npos) text.replace(opening + 1, from.size(), to);
  const std::size_t closing = text.rfind("</" + from);
  if (closing != std::string::npos) text.replace(closing + 2, from.size(), to);
}

}  // namespace

std::optional<SceneText> scene_text(const std::filesystem::path& file) {
  if (file.extension() == ".xacro") return SceneText{run_xacro(file), file.string() + " (as xacro expands it)"};
  std::ifstream stream(file);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  tinyxml2::XMLDocument document;
  if (document.Parse(text.c_str(), text.size()) != tinyxml2::XML_SUCCESS) return std::nullopt;  // told later
  const tinyxml2::XMLElement* root = document.RootElement();
  const std::string old_name = "gazebo";
  if (root == nullptr || root->Name() != old_name) return std::nullopt;
  rename_root(text, old_name, "sdf");
  return SceneText{text, file.string()};
}

}  // namespace bubblesim
