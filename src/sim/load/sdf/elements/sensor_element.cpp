// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/sensor_element.hpp"

#include <algorithm>

#include "bubblesim/nearest_names.hpp"
#include "load/load_context.hpp"
#include "load/sdf/elements/own_elements.hpp"
#include "load/sdf/elements/sdf_element.hpp"

namespace bubblesim {
namespace {

/// The last name of a path, and the path above it.
std::pair<std::string_view, std::string_view> split(std::string_view path) {
  const std::size_t slash = path.rfind('/');
  if (slash == std::string_view::npos) return {"", path};
  return {path.substr(0, slash), path.substr(slash + 1)};
}

}  // namespace

SdfElement SensorElement::at(std::string_view path) const {
  SdfElement element = sensor_;
  bool is_first = true;
  while (!path.empty()) {
    const std::size_t end = std::min(path.find('/'), path.size());
    const std::string_view name = path.substr(0, end);
    element = is_first && part_ != nullptr && part_->xml().name == name ? *part_ : element.child(name);
    is_first = false;
    path.remove_prefix(std::min(end + 1, path.size()));
  }
  return element;
}

bool SensorElement::has(std::string_view path) const { return static_cast<bool>(at(path)); }

double SensorElement::number(std::string_view path) const { return at(path).as_number(); }

int SensorElement::integer(std::string_view path) const {
  constexpr double kMost = 1e9;
  return static_cast<int>(std::max(-kMost, std::min(number(path), kMost)));
}

std::string SensorElement::text(std::string_view path) const { return at(path).as_text(); }

Pose SensorElement::pose(std::string_view path) const { return at(path).as_pose(); }

std::vector<std::string> SensorElement::strings(std::string_view path) const {
  const auto [parent, name] = split(path);
  std::vector<std::string> all;
  for (const SdfElement& element : at(parent).children(name)) all.push_back(element.as_text());
  return all;
}

NoiseDescription SensorElement::noise(std::string_view path) const {
  const SdfElement noise = at(path);
  NoiseDescription description;
  const std::string type = noise.has_attribute("type") ? noise.attribute("type") : noise.text("type");
  if (!noise || (type != "gaussian" && type != "gaussian_quantized")) return description;
  description.mean = noise.number("mean");
  description.stddev = noise.number("stddev");
  description.bias_mean = noise.number("bias_mean");
  description.bias_stddev = noise.number("bias_stddev");
  if (type == "gaussian_quantized") description.precision = noise.number("precision");
  return description;
}

std::array<NoiseDescription, 3> SensorElement::noise_of_axes(std::string_view path) const {
  const std::string axes(path);
  return {noise(axes + "/x/noise"), noise(axes + "/y/noise"), noise(axes + "/z/noise")};
}

double SensorElement::own_number(std::string_view path) const {
  const auto [parent, name] = split(path);
  return bubblesim::own_number(at(parent), name, path_, context_).value_or(0);
}

bool SensorElement::own_flag(std::string_view path) const {
  const auto [parent, name] = split(path);
  const std::string given = own_text(at(parent), name).value_or("false");
  if (is_true(given)) return true;
  if (given != "false" && given != "0") {
    report(path, "<" + std::string(name) + "> is '" + given + "', it must be true or false");
  }
  return false;
}

std::optional<std::size_t> SensorElement::choice(std::string_view path, const std::vector<std::string>& names) const {
  const std::string given = text(path);
  const auto found = std::find(names.begin(), names.end(), given);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  report(path, "<" + std::string(split(path).second) + "> is '" + given + "', it must be " + joined(names, " or ") +
                   did_you_mean(given, names));
  return std::nullopt;
}

void SensorElement::report(std::string_view path, std::string message) const {
  context_.report(source_of(path), path_, std::move(message));
}

void SensorElement::warn(std::string_view path, std::string message) const {
  context_.warn(source_of(path), path_, std::move(message));
}

/// The place of an element if the file has it, otherwise that of the one above.
Source SensorElement::source_of(std::string_view path) const {
  const auto [parent, name] = split(path);
  const SdfElement element = at(path);
  return element || path.empty() ? element.source() : at(parent).source();
}

}  // namespace bubblesim
