// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <sstream>

#include "load/ttt/read_objects.hpp"

namespace bubblesim::ttt {
namespace {

/// Whether a script begins with a line `#python`, after empty lines and other lines that begin with #.
bool names_python(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos) continue;
    if (line.compare(first, 7, "#python") == 0) return true;
    if (line[first] != '#') return false;
  }
  return false;
}

ScriptKind kind_of(int kind) {
  switch (kind) {
    case 0:
      return ScriptKind::kMain;
    case 1:
      return ScriptKind::kChild;
    case 6:
      return ScriptKind::kCustomization;
    default:
      return ScriptKind::kOther;
  }
}

}  // namespace

std::string clear_text(std::string_view obscured) {
  std::string text(obscured);
  if (text.size() >= 3) {
    const int s = static_cast<std::int8_t>(text.front()) / 2;
    const int e = 3 * static_cast<std::int8_t>(text.back());
    for (std::size_t i = 1; i + 1 < text.size(); ++i) {
      const auto n = static_cast<std::int64_t>(i);
      std::int64_t value = static_cast<std::uint8_t>(text[i]);
      if ((i & 1U) != 0) value += n + s + e;
      if ((i & 2U) != 0) value -= 3 * n + s;
      if ((i & 4U) != 0) value += n / 2 + e;
      text[i] = static_cast<char>(static_cast<std::uint8_t>(value));
    }
  }
  while (!text.empty() && text.back() == '\0') text.pop_back();
  return text;
}

std::vector<Parameter> read_parameters(const TagList& list) {
  std::vector<Parameter> parameters;
  auto bytes = list.item("Par");
  if (!bytes) return parameters;
  constexpr std::size_t kLeast = 16;  // bytes of three empty strings and the flags
  note_damage(list.damage(), [&] {
    for (std::size_t count = bytes->count(kLeast); count > 0; --count) {
      Parameter parameter;
      parameter.name = bytes->text();
      parameter.unit = bytes->text();
      parameter.value = bytes->text();
      bytes->i32();  // flags
      parameters.push_back(std::move(parameter));
    }
  });
  return parameters;
}

Script read_script(const TagList& list) {
  Script script;
  if (auto bytes = list.item("Si2")) {
    script.handle = bytes->i32();
    script.object = bytes->i32();
    script.kind = kind_of(bytes->i32());
  }
  if (const int object = list.integer("Coc", -1); object >= 0) script.object = object;
  if (auto bytes = list.item("Ste")) script.text = clear_text(bytes->take(bytes->left()));
  const unsigned bits = list.u8("Va2").value_or(8);
  script.is_threaded = (bits & 1U) != 0;
  script.is_disabled = (bits & 2U) != 0;
  constexpr std::size_t kLongestLoader = 400;  // bytes of scripts that load the default main script by its name
  const bool is_default = (bits & 8U) == 0 || script.text.size() < kLongestLoader;
  script.is_default_main = script.kind == ScriptKind::kMain && is_default;
  const auto language = list.text("Lne");
  script.parameters = read_parameters(list.list("Prm"));
  script.is_python = language ? *language == "python" : names_python(script.text);
  return script;
}

}  // namespace bubblesim::ttt
