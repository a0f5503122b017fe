// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>

#include "parameters/parameter_value.hpp"

namespace bubblesim::ros2 {

/// The parameters of this node. For the simulation's thread.
class NodeParameters {
 public:
  enum class Change { kNew, kChanged, kDeleted };

  /// `node`: full name. `given`: values of the command line as strings. use_sim_time is always there. Throws
  /// std::invalid_argument for one that is not a bool.
  NodeParameters(std::string node, const std::map<std::string, std::string>& given);

  /// `name`: `use_sim_time`, `~use_sim_time`, or with the full name of the node, `/sim/use_sim_time`.
  std::optional<Value> get(const std::string& name) const;
  /// Sets a value, std::monostate deletes. Throws std::invalid_argument for a value that the parameter cannot have.
  void set(const std::string& name, const Value& value);
  /// Why it cannot have this value; empty if it can.
  std::string refusal(const std::string& name, const Value& value) const;
  /// The name if the node has the parameter.
  std::optional<std::string> search(const std::string& name) const;
  const std::map<std::string, Value>& all() const { return values_; }
  bool use_sim_time() const;

  /// Called after each change.
  std::function<void(Change change, const std::string& name, const Value& value)> on_change;

 private:
  std::string own_name(const std::string& name) const;

  const std::string node_;
  std::map<std::string, Value> values_;
};

}  // namespace bubblesim::ros2
