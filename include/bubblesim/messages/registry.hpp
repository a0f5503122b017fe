// SPDX-License-Identifier: BSD-3-Clause
// Which message and service types this process knows: the listed ones, which come from meta/messages.txt and
// meta/services.txt, and those that were added since.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bubblesim/messages/message_type.hpp"

namespace bubblesim::messages {

/// The type of that name (`pkg/Type`, also `pkg/msg/Type`), or nullptr when it is not known. Halves of services are
/// found, too (`std_srvs/SetBoolRequest`). Thread-safe.
const MessageType* find_message(std::string_view name);

/// The service of that name (`pkg/Type`, also `pkg/srv/Type`), or nullptr when it is not known. Thread-safe.
const ServiceType* find_service(std::string_view name);

/// Adds a type that is not listed, and returns the one that is known from now on: of several that are the same, the
/// first. The messages in its fields must be the registry's own; field keys are filled in here. Throws
/// std::invalid_argument when another definition of that name is known. Thread-safe.
const MessageType& add_message(MessageType type);

/// The same for a service; the name and md5 of the halves are theirs, not the service's.
const ServiceType& add_service(std::string name, std::string md5, MessageType request, MessageType response);

/// Names of all listed types, sorted; types that only occur nested in others are included, halves of services are not.
std::vector<std::string> message_names();
std::vector<std::string> service_names();

/// Listed names that look like `name`, best first, at most three: for "did you mean".
std::vector<std::string> similar_message_names(std::string_view name);
std::vector<std::string> similar_service_names(std::string_view name);

/// Index of a field name, the same for the same name throughout the process; counts up from 0. Thread-safe.
std::uint32_t field_key(std::string_view name);

}  // namespace bubblesim::messages
