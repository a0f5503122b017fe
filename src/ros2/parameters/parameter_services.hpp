// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "bubblesim/messages/bridge.hpp"
#include "parameters/node_parameters.hpp"

namespace bubblesim::ros2 {

/// Calls `add` with the name below the node, the type and the answers of each service by which other nodes read and set
/// the parameters, which must outlive the services: `get_parameters`, rcl_interfaces/GetParameters.
void add_parameter_services(
    NodeParameters& parameters,
    const std::function<void(const std::string& name, const std::string& type, messages::ServiceCallback)>& add);

/// An rcl_interfaces/ParameterEvent.
messages::WireBuffer parameter_event(messages::BridgeTime time, const std::string& node, NodeParameters::Change change,
                                     const std::string& name, const Value& value);

}  // namespace bubblesim::ros2
