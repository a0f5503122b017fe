// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/elements/own_elements.hpp"

#include "scene/text_values.hpp"

namespace bubblesim {
namespace {

std::optional<std::vector<double>> own_numbers(const SdfElement& parent, std::string_view name, std::size_t count,
                                               const std::string& wanted, const std::string& path,
                                               LoadContext& context) {
  const std::optional<std::string> text = own_text(parent, name);
  if (!text) return std::nullopt;
  std::optional<std::vector<double>> numbers = to_numbers(*text);
  if (numbers && numbers->size() == count) return numbers;
  context.report(parent.source(name), path, "<" + std::string(name) + "> is '" + *text + "', it must be " + wanted);
  return std::nullopt;
}

}  // namespace

std::optional<std::string> own_text(const SdfElement& parent, std::string_view name) {
  if (!parent.has(name)) return std::nullopt;
  return parent.text(name);
}

std::optional<double> own_number(const SdfElement& parent, std::string_view name, const std::string& path,
                                 LoadContext& context) {
  const auto numbers = own_numbers(parent, name, 1, "a number", path, context);
  return numbers ? std::make_optional(numbers->front()) : std::nullopt;
}

std::optional<Vector3> own_vector(const SdfElement& parent, std::string_view name, const std::string& path,
                                  LoadContext& context) {
  const auto numbers = own_numbers(parent, name, 3, "three numbers", path, context);
  return numbers ? std::make_optional(Vector3((*numbers)[0], (*numbers)[1], (*numbers)[2])) : std::nullopt;
}

std::optional<std::vector<double>> to_numbers(const std::string& text) {
  std::vector<double> numbers;
  return read_numbers(text, numbers) ? std::make_optional(std::move(numbers)) : std::nullopt;
}

}  // namespace bubblesim
