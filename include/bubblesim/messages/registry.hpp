// SPDX-License-Identifier: BSD-3-Clause
// The message and service types that this process knows: the listed ones, from meta/messages.txt and meta/services.txt,
// and those added at run time.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bubblesim/messages/message_type.hpp"

namespace bubblesim::messages {

/// Returns the type of that name (`pkg/Type`, also `pkg/msg/Type`) in a version of ROS, or nullptr if it is unknown
/// there. Also finds the requests and responses of services (`std_srvs/SetBoolRequest`). Thread-safe.
const MessageType* find_message(std::string_view name, RosVersion version = RosVersion::kRos1);

/// Returns the service of that name (`pkg/Type`, also `pkg/srv/Type`), or nullptr if it is unknown. Thread-safe.
const ServiceType* find_service(std::string_view name, RosVersion version = RosVersion::kRos1);

/// Adds a type that is not listed and returns the registered type: if an equal type exists already, that one. The
/// messages in its fields must belong to the registry, in the same version; field keys are filled in here. Throws
/// std::invalid_argument when the name has another definition already. Thread-safe.
const MessageType& add_message(MessageType type);

/// Like add_message(), for a service; request and response have their own name and hash.
const ServiceType& add_service(std::string name, std::string type_hash, MessageType request, MessageType response);

/// Names of all listed types, sorted. Includes types that only occur nested in others; excludes requests and responses
/// of services. Those of ROS 2 are in a build with ROS 2 only.
std::vector<std::string> message_names(RosVersion version = RosVersion::kRos1);
std::vector<std::string> service_names(RosVersion version = RosVersion::kRos1);

/// Listed names that are similar to `name`, best match first, at most three; for "did you mean".
std::vector<std::string> similar_message_names(std::string_view name, RosVersion version = RosVersion::kRos1);
std::vector<std::string> similar_service_names(std::string_view name, RosVersion version = RosVersion::kRos1);

/// Whether ROS_DISTRO names a distribution of ROS 2 before Iron: a few types had other fields then.
bool ros2_is_before_iron();

/// Index of a field name; equal for equal names throughout the process. Indices count up from 0. Thread-safe.
std::uint32_t field_key(std::string_view name);

}  // namespace bubblesim::messages
