// SPDX-License-Identifier: BSD-3-Clause
#include "node_parameters.hpp"

#include <charconv>
#include <utility>

namespace bubblesim::ros2 {
namespace {

using messages::ParameterValue;

template <class Number>
std::optional<Number> number_of(const std::string& text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

ParameterValue value_of(const std::string& text) {
  if (text == "true" || text == "True") return true;
  if (text == "false" || text == "False") return false;
  if (const auto integer = number_of<std::int32_t>(text)) return *integer;
  if (const auto real = number_of<double>(text)) return *real;
  return text;
}

}  // namespace

NodeParameters::NodeParameters(std::string node, const std::map<std::string, std::string>& given)
    : node_(std::move(node)) {
  for (const auto& [name, text] : given) values_[name] = value_of(text);
}

std::string NodeParameters::own_name(const std::string& name) const {
  if (name.rfind(node_ + "/", 0) == 0) return name.substr(node_.size() + 1);
  const std::size_t begin = name.find_first_not_of("~/");
  return begin == std::string::npos ? name : name.substr(begin);
}

std::optional<ParameterValue> NodeParameters::get(const std::string& name) const {
  const auto found = values_.find(own_name(name));
  if (found == values_.end()) return std::nullopt;
  return found->second;
}

void NodeParameters::set(const std::string& name, const ParameterValue& value) { values_[own_name(name)] = value; }

void NodeParameters::remove(const std::string& name) { values_.erase(own_name(name)); }

std::optional<std::string> NodeParameters::search(const std::string& name) const {
  if (values_.count(own_name(name)) == 0) return std::nullopt;
  return own_name(name);
}

}  // namespace bubblesim::ros2
