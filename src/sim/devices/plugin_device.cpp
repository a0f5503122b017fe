// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/plugin_device.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "bubblesim/nearest_names.hpp"
#include "scene/text_values.hpp"

namespace bubblesim {
namespace {

/// Returns the finite numbers of a string; nothing if it has anything else.
std::optional<std::vector<double>> numbers_in(const std::string& text) {
  std::vector<double> numbers;
  const bool is_read = read_numbers(text, numbers);
  const bool is_finite = std::all_of(numbers.begin(), numbers.end(), [](double each) { return std::isfinite(each); });
  return is_read && is_finite ? std::make_optional(std::move(numbers)) : std::nullopt;
}

ObjectId part_named(const PluginPlace& place, const std::string& parameter, ObjectKind kind) {
  const SceneTree& tree = place.world.tree();
  const std::string name = place.parameters.text(parameter);
  std::vector<std::string> names;
  for (const ObjectId part : tree.parts(place.model, kind)) {
    if (tree.at(part).name == name) return part;
    names.push_back(tree.at(part).name);
  }
  throw place.parameters.error(parameter, "is '" + name + "', which is not a " + std::string(kind_name(kind)) + " of " +
                                              tree.path(place.model) + did_you_mean(name, names));
}

}  // namespace

const PluginParameter* PluginParameters::find(const std::string& name) const {
  names_read_.insert(name);
  const auto& all = plugin_.parameters;
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& each) { return each.name == name; });
  return found == all.end() ? nullptr : &*found;
}

const PluginParameter& PluginParameters::required(const std::string& name) const {
  if (const PluginParameter* found = find(name)) return *found;
  throw error(name, "is missing");
}

PluginParameterError PluginParameters::error(const std::string& name, const std::string& problem) const {
  const PluginParameter* found = find(name);
  const Source& source = found == nullptr ? plugin_.source : found->source;
  return PluginParameterError(source.file + (source.line > 0 ? ":" + std::to_string(source.line) : "") + ": plugin '" +
                              plugin_.name + "': <" + name + "> " + problem);
}

std::string PluginParameters::text(const std::string& name) const { return trimmed(required(name).text); }

std::string PluginParameters::text(const std::string& name, const std::string& fallback) const {
  const PluginParameter* found = find(name);
  return found == nullptr ? fallback : trimmed(found->text);
}

double PluginParameters::number_in(const PluginParameter& parameter) const {
  const auto numbers = numbers_in(parameter.text);
  if (numbers && numbers->size() == 1) return numbers->front();
  throw error(parameter.name, "is '" + trimmed(parameter.text) + "', it must be a number");
}

double PluginParameters::number(const std::string& name) const { return number_in(required(name)); }

double PluginParameters::number(const std::string& name, double fallback) const {
  const PluginParameter* found = find(name);
  return found == nullptr ? fallback : number_in(*found);
}

bool PluginParameters::flag(const std::string& name, bool fallback) const {
  const std::string given = text(name, fallback ? "true" : "false");
  if (given == "true" || given == "1") return true;
  if (given == "false" || given == "0") return false;
  throw error(name, "is '" + given + "', it must be true or false");
}

Vector3 PluginParameters::vector(const std::string& name, const Vector3& fallback) const {
  const PluginParameter* found = find(name);
  if (found == nullptr) return fallback;
  const auto numbers = numbers_in(found->text);
  if (numbers && numbers->size() == 3) return {(*numbers)[0], (*numbers)[1], (*numbers)[2]};
  throw error(name, "is '" + trimmed(found->text) + "', it must be three numbers");
}

ObjectId PluginPlace::link(const std::string& parameter) const {
  return part_named(*this, parameter, ObjectKind::kLink);
}

ObjectId PluginPlace::joint(const std::string& parameter) const {
  return part_named(*this, parameter, ObjectKind::kJoint);
}

PluginDevice::~PluginDevice() = default;

template <class Call>
void SwitchedDevice::guarded(const char* function, const Call& call) {
  if (!failure_.empty()) return;
  try {
    call();
  } catch (...) {  // the user may throw anything
    failure_ = std::string(function) + ": " + text_of_handled_exception();
  }
}

void SwitchedDevice::update(World& world, double time, double duration) {
  guarded("update()", [&] { device_->update(world, time, duration); });
}

void SwitchedDevice::reset(World& world) {
  guarded("reset()", [&] { device_->reset(world); });
}

}  // namespace bubblesim
