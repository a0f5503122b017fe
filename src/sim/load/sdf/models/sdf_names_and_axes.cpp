// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/models/sdf_names_and_axes.hpp"

#include <algorithm>
#include <cctype>
#include <optional>

#include "bubblesim/nearest_names.hpp"
#include "load/sdf/elements/own_elements.hpp"

namespace bubblesim {
namespace {

constexpr const char* kAlias = "bubblesim:alias";
constexpr const char* kAxisConvention = "bubblesim:axis_convention";

bool is_alias(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char sign) {
    return std::isalnum(sign) != 0 || sign == '_' || sign == '-';
  });
}

}  // namespace

std::string read_alias(const SdfElement& element, const std::string& path, LoadContext& context) {
  const std::optional<std::string> given = own_text(element, kAlias);
  if (!given || is_alias(*given)) return given.value_or("");
  context.report(element.source(kAlias), path,
                 "<" + std::string(kAlias) + "> is '" + *given + "', it must consist of letters, digits, _ and -");
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
