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

/// Returns the type of that name (`pkg/Type`, also `pkg/msg/Type`), or nullptr if it is unknown. Also finds the
/// requests and responses of services (`std_srvs/SetBoolRequest`). Thread-safe.
const MessageType* find_message(std::string_view name);

/// Returns the service of that name (`pkg/Type`, also `pkg/srv/Type`), or nullptr if it is unknown. Thread-safe.
const ServiceType* find_service(std::string_view name);

/// Adds a type that is not listed and returns the registered type: if an equal type exists already, that one. The
/// messages in its fields must belong to the registry; field keys are filled in here. Throws std::invalid_argument when
/// the name has another definition already. Thread-safe.
const MessageType& add_message(MessageType type);

/// Like add_message(), for a service; request and response have their own name and md5.
const ServiceType& add_service(std::string name, std::string md5, MessageType request, MessageType response);

/// Names of all listed types, sorted. Includes types that only occur nested in others; excludes requests and responses
/// of services.
std::vector<std::string> message_names();
std::vector<std::string> service_names();

/// Listed names that are similar to `name`, best match first, at most three; for "did you mean".
std::vector<std::string> similar_message_names(std::string_view name);
std::vector<std::string> similar_service_names(std::string_view name);

/// Index of a field name; equal for equal names throughout the process. Indices count up from 0. Thread-safe.
std::uint32_t field_key(std::string_view name);

}  // namespace bubblesim::messages
