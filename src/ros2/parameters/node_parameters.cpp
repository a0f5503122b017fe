// SPDX-License-Identifier: BSD-3-Clause
#include "parameters/node_parameters.hpp"

#include <stdexcept>
#include <utility>

namespace bubblesim::ros2 {
namespace {

constexpr const char* kUseSimTime = "use_sim_time";

}  // namespace

NodeParameters::NodeParameters(std::string node, const std::map<std::string, std::string>& given)
    : node_(std::move(node)), values_{{kUseSimTime, false}} {
  for (const auto& [name, text] : given) set(name, value_of(text));
}

std::string NodeParameters::own_name(const std::string& name) const {
  if (name.rfind(node_ + "/", 0) == 0) return name.substr(node_.size() + 1);
  const std::size_t begin = name.find_first_not_of("~/");
  return begin == std::string::npos ? name : name.substr(begin);
}

std::optional<Value> NodeParameters::get(const std::string& name) const {
  const auto found = values_.find(own_name(name));
  if (found == values_.end()) return std::nullopt;
  return found->second;
}

std::string NodeParameters::refusal(const std::string& name, const Value& value) const {
  if (name.empty()) return "a parameter needs a name";
  if (own_name(name) == kUseSimTime && !std::holds_alternative<bool>(value))
    return "use_sim_time must be true or false";
  return {};
}

void NodeParameters::set(const std::string& name, const Value& value) {
  const std::string own = own_name(name);
  if (const std::string why = refusal(own, value); !why.empty()) throw std::invalid_argument(why);
  Change change = values_.count(own) != 0 ? Change::kChanged : Change::kNew;
  if (std::holds_alternative<std::monostate>(value)) {
    if (change == Change::kNew) return;
    change = Change::kDeleted;
    values_.erase(own);
  } else {
    values_[own] = value;
  }
  if (on_change) on_change(change, own, value);
}

std::optional<std::string> NodeParameters::search(const std::string& name) const {
  if (values_.count(own_name(name)) == 0) return std::nullopt;
  return own_name(name);
}

bool NodeParameters::use_sim_time() const { return std::get<bool>(values_.at(kUseSimTime)); }

}  // namespace bubblesim::ros2
