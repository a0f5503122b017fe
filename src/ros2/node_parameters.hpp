// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>

#include "bubblesim/messages/bridge.hpp"

namespace bubblesim::ros2 {

/// The parameters of this node.
class NodeParameters {
 public:
  /// `node`: full name. `given`: values of the command line as texts, such as "true", "3", "0.5", "words".
  NodeParameters(std::string node, const std::map<std::string, std::string>& given);

  /// `name`: `use_sim_time`, `~use_sim_time`, or with the full name of the node, `/sim/use_sim_time`.
  std::optional<messages::ParameterValue> get(const std::string& name) const;
  void set(const std::string& name, const messages::ParameterValue& value);
  void remove(const std::string& name);
  /// The name if the node has the parameter.
  std::optional<std::string> search(const std::string& name) const;

 private:
  std::string own_name(const std::string& name) const;

  const std::string node_;
  std::map<std::string, messages::ParameterValue> values_;
};

}  // namespace bubblesim::ros2
