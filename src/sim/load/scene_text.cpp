// SPDX-License-Identifier: BSD-3-Clause
#include "load/scene_text.hpp"

#include <fstream>
#include <iterator>

#include "load/urdf/xacro.hpp"
#include "load/xml_lines.hpp"

namespace bubblesim {
namespace {

/// Some files are in Latin-1, regardless of their declaration: all other readers expect UTF-8.
bool is_utf8(const std::string& text) {
  std::size_t following = 0;
  for (const char character : text) {
    const auto byte = static_cast<unsigned char>(character);
    if (following > 0) {
      if ((byte & 0xC0U) != 0x80U) return false;
      --following;
    } else if (byte >= 0x80U) {
      following = byte >= 0xF0U ? 3 : byte >= 0xE0U ? 2 : 1;
      if (byte < 0xC2U || byte > 0xF4U) return false;
    }
  }
  return following == 0;
}

std::string from_latin1(const std::string& text) {
  std::string converted;
  for (const char character : text) {
    const auto byte = static_cast<unsigned char>(character);
    if (byte < 0x80U) {
      converted += character;
    } else {
      converted += static_cast<char>(0xC0U | (byte >> 6U));
      converted += static_cast<char>(0x80U | (byte & 0x3FU));
    }
  }
  return converted;
}

}  // namespace

std::optional<SceneText> scene_text(const std::filesystem::path& file, const XacroArguments& arguments) {
  if (file.extension() == ".xacro") {
    return SceneText{run_xacro(file, arguments), file.string() + " (expanded by xacro)"};
  }
  std::ifstream stream(file);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  const std::string original = text;
  text = without_late_declaration(std::move(text));
  if (!is_utf8(text)) text = from_latin1(text);
  if (text == original) return std::nullopt;
  return SceneText{text, file.string()};
}

}  // namespace bubblesim
