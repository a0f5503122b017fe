// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/sdf_names_and_axes.hpp"

#include <algorithm>
#include <cctype>
#include <optional>

#include "bubblesim/nearest_names.hpp"
#include "load/sdf/sdf_source.hpp"
#include "load/sdf_extensions.hpp"

namespace bubblesim {
namespace {

constexpr const char* kAlias = "bubblesim:alias";
constexpr const char* kAxisConvention = "bubblesim:axis_convention";

/// A text in the <include> of an element or in the element itself, and its place.
struct GivenText {
  std::string text;
  Source source;
};

std::optional<GivenText> text_in_include_or(const sdf::ElementPtr& element, const char* name, LoadContext& reading) {
  if (const sdf::ElementPtr include = element->GetIncludeElement()) {
    if (const auto text = own_text(include, name)) return GivenText{*text, reading.xml().place_of(name, *text)};
  }
  if (const auto text = own_text(element, name)) return GivenText{*text, source_of(element, name)};
  return std::nullopt;
}

bool is_alias(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char sign) {
    return std::isalnum(sign) != 0 || sign == '_' || sign == '-';
  });
}

}  // namespace

std::string read_alias(const sdf::ElementPtr& element, const std::string& path, LoadContext& reading) {
  const auto given = text_in_include_or(element, kAlias, reading);
  if (!given || is_alias(given->text)) return given ? given->text : "";
  reading.report(given->source, path,
                 "<" + std::string(kAlias) + "> is '" + given->text + "', it must consist of letters, digits, _ and -");
  return "";
}

AxisConvention read_axis_convention(const sdf::ElementPtr& element, const std::string& path, LoadContext& reading) {
  const auto given = text_in_include_or(element, kAxisConvention, reading);
  if (!given) return reading.axes();
  if (given->text == "coppeliasim") return AxisConvention::kCoppeliaSim;
  if (given->text != "sdformat") {
    reading.report(given->source, path,
                   "<" + std::string(kAxisConvention) + "> is '" + given->text +
                       "', it must be coppeliasim or sdformat" +
                       did_you_mean(given->text, {"coppeliasim", "sdformat"}));
  }
  return AxisConvention::kSdformat;
}

}  // namespace bubblesim
