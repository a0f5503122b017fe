// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/models/sdf_names_and_axes.hpp"

#include <algorithm>
#include <optional>
#include <string_view>

#include "bubblesim/nearest_names.hpp"
#include "load/sdf/elements/own_elements.hpp"

namespace bubblesim {
namespace {

constexpr const char* kAlias = "bubblesim:alias";
constexpr const char* kAxisConvention = "bubblesim:axis_convention";

/// What paths can lead to: they give other meanings to some signs.
bool is_alias(const std::string& text) {
  return !text.empty() && text.front() != '.' && text.front() != ':' &&
         std::all_of(text.begin(), text.end(), [](unsigned char sign) {
           return sign >= ' ' && sign != 0x7f &&
                  std::string_view("/[]{}*").find(static_cast<char>(sign)) == std::string_view::npos;
         });
}

}  // namespace

std::string read_alias(const SdfElement& element, const std::string& path, LoadContext& context) {
  const std::optional<std::string> given = own_text(element, kAlias);
  if (!given || is_alias(*given)) return given.value_or("");
  context.report(
      element.source(kAlias), path,
      "<" + std::string(kAlias) + "> is '" + *given + "', it must not have / [ ] { } * or begin with . or :");
  return "";
}

AxisConvention read_axis_convention(const SdfElement& element, const std::string& path, LoadContext& context) {
  const std::optional<std::string> given = own_text(element, kAxisConvention);
  if (!given) return context.axes();
  if (*given == "coppeliasim") return AxisConvention::kCoppeliaSim;
  if (*given != "sdformat") {
    context.report(element.source(kAxisConvention), path,
                   "<" + std::string(kAxisConvention) + "> is '" + *given + "', it must be coppeliasim or sdformat" +
                       did_you_mean(*given, {"coppeliasim", "sdformat"}));
  }
  return AxisConvention::kSdformat;
}

}  // namespace bubblesim
