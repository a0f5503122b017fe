// SPDX-License-Identifier: BSD-3-Clause
#include "parameters/parameter_services.hpp"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

namespace bubblesim::ros2 {
namespace {

using messages::WireBuffer;
using messages::WireView;

using Named = std::vector<std::pair<std::string, Value>>;

WireBuffer response() {
  WireBuffer out;
  out.begin(messages::Layout::kCdr);
  return out;
}

std::vector<std::string> get_names(WireView& request) {
  std::vector<std::string> names;
  for (auto left = request.get<std::uint32_t>(); left > 0; --left) names.push_back(get_string(request));
  return names;
}

Named get_parameters_of(WireView& request) {
  Named parameters;
  for (auto left = request.get<std::uint32_t>(); left > 0; --left) {
    std::string name = get_string(request);
    parameters.emplace_back(std::move(name), get_value(request));
  }
  return parameters;
}

Value value_or_none(const NodeParameters& parameters, const std::string& name) {
  return parameters.get(name).value_or(std::monostate());
}

void put_names(const std::set<std::string>& names, WireBuffer& out) {
  out.put(static_cast<std::uint32_t>(names.size()));
  for (const std::string& name : names) out.put_string(name);
}

/// An rcl_interfaces/SetParametersResult.
void put_result(const std::string& refusal, WireBuffer& out) {
  out.put(static_cast<std::uint8_t>(refusal.empty() ? 1 : 0));
  out.put_string(refusal);
}

WireBuffer get_parameters(const NodeParameters& parameters, WireView request) {
  WireBuffer out = response();
  const std::vector<std::string> names = get_names(request);
  out.put(static_cast<std::uint32_t>(names.size()));
  for (const std::string& name : names) put(value_or_none(parameters, name), out);
  return out;
}

WireBuffer get_types(const NodeParameters& parameters, WireView request) {
  WireBuffer out = response();
  const std::vector<std::string> names = get_names(request);
  out.put(static_cast<std::uint32_t>(names.size()));
  for (const std::string& name : names) {
    out.put(static_cast<std::uint8_t>(value_or_none(parameters, name).index()));
  }
  return out;
}

WireBuffer describe(const NodeParameters& parameters, WireView request) {
  WireBuffer out = response();
  const std::vector<std::string> names = get_names(request);
  out.put(static_cast<std::uint32_t>(names.size()));
  for (const std::string& name : names) {
    out.put_string(name);
    out.put(static_cast<std::uint8_t>(value_or_none(parameters, name).index()));
    out.put_string("");         // description
    out.put_string("");         // constraints
    out.put(std::uint8_t{0});   // read only
    out.put(std::uint8_t{1});   // may change its type
    out.put(std::uint32_t{0});  // ranges of floats
    out.put(std::uint32_t{0});  // ranges of integers
  }
  return out;
}

WireBuffer set_each(NodeParameters& parameters, WireView request) {
  WireBuffer out = response();
  const Named given = get_parameters_of(request);
  out.put(static_cast<std::uint32_t>(given.size()));
  for (const auto& [name, value] : given) {
    const std::string refusal = parameters.refusal(name, value);
    if (refusal.empty()) parameters.set(name, value);
    put_result(refusal, out);
  }
  return out;
}

WireBuffer set_together(NodeParameters& parameters, WireView request) {
  WireBuffer out = response();
  const Named given = get_parameters_of(request);
  std::string refusal;
  for (const auto& [name, value] : given) {
    if (refusal.empty()) refusal = parameters.refusal(name, value);
  }
  if (refusal.empty()) {
    for (const auto& [name, value] : given) parameters.set(name, value);
  }
  put_result(refusal, out);
  return out;
}

/// The parts of a name are separated by dots; a depth counts them, below the prefix; 0: any number.
WireBuffer list(const NodeParameters& parameters, WireView request) {
  WireBuffer out = response();
  const std::vector<std::string> prefixes = get_names(request);
  const auto depth = request.get<std::uint64_t>();
  const auto within = [depth](const std::string& rest) {
    return depth == 0 || static_cast<std::uint64_t>(std::count(rest.begin(), rest.end(), '.')) < depth;
  };
  std::set<std::string> names;
  std::set<std::string> parents;
  for (const auto& [name, value] : parameters.all()) {
    const bool fits =
        prefixes.empty() ? within(name) : std::any_of(prefixes.begin(), prefixes.end(), [&](const std::string& prefix) {
          if (name == prefix) return true;
          return name.rfind(prefix + ".", 0) == 0 && within(name.substr(prefix.size() + 1));
        });
    if (!fits) continue;
    names.insert(name);
    if (const std::size_t dot = name.rfind('.'); dot != std::string::npos) parents.insert(name.substr(0, dot));
  }
  put_names(names, out);
  put_names(parents, out);
  return out;
}

}  // namespace

void add_parameter_services(
    NodeParameters& parameters,
    const std::function<void(const std::string& name, const std::string& type, messages::ServiceCallback)>& add) {
  const auto offer = [&](const char* name, const char* type, WireBuffer (*answer)(NodeParameters&, WireView)) {
    add(name, type, [&parameters, answer](WireView request) {
      request.begin(messages::Layout::kCdr);
      try {
        return answer(parameters, request);
      } catch (const messages::WireError& error) {
        throw messages::ServiceError(error.what());
      }
    });
  };
  offer("get_parameters", "rcl_interfaces/GetParameters",
        [](NodeParameters& of, WireView request) { return get_parameters(of, request); });
  offer("get_parameter_types", "rcl_interfaces/GetParameterTypes",
        [](NodeParameters& of, WireView request) { return get_types(of, request); });
  offer("describe_parameters", "rcl_interfaces/DescribeParameters",
        [](NodeParameters& of, WireView request) { return describe(of, request); });
  offer("list_parameters", "rcl_interfaces/ListParameters",
        [](NodeParameters& of, WireView request) { return list(of, request); });
  offer("set_parameters", "rcl_interfaces/SetParameters", set_each);
  offer("set_parameters_atomically", "rcl_interfaces/SetParametersAtomically", set_together);
}

WireBuffer parameter_event(messages::BridgeTime time, const std::string& node, NodeParameters::Change change,
                           const std::string& name, const Value& value) {
  WireBuffer out = response();
  out.put(time.sec);
  out.put(time.nanosec);
  out.put_string(node);
  for (const auto kind :
       {NodeParameters::Change::kNew, NodeParameters::Change::kChanged, NodeParameters::Change::kDeleted}) {
    out.put(std::uint32_t{kind == change ? 1U : 0U});
    if (kind != change) continue;
    out.put_string(name);
    put(value, out);
  }
  return out;
}

}  // namespace bubblesim::ros2
