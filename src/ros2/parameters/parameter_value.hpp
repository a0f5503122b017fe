// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "bubblesim/messages/bridge.hpp"

namespace bubblesim::ros2 {

/// The value of a parameter. The index of the alternative is the type's number in rcl_interfaces/ParameterType.
using Value = std::variant<std::monostate, bool, std::int64_t, double, std::string, std::vector<std::uint8_t>,
                           std::vector<bool>, std::vector<std::int64_t>, std::vector<double>, std::vector<std::string>>;

/// As scripts see it: lists are std::monostate, integers above 32 bits are floats.
messages::ParameterValue for_script(const Value& value);
Value from_script(const messages::ParameterValue& value);

/// Of the command line, such as "true", "3", "0.5", "words".
Value value_of(const std::string& text);

/// As rcl_interfaces/ParameterValue.
void put(const Value& value, messages::WireBuffer& out);
/// Throws messages::WireError for a message that is too short.
Value get_value(messages::WireView& message);
std::string get_string(messages::WireView& message);

}  // namespace bubblesim::ros2
