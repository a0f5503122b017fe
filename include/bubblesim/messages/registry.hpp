// SPDX-License-Identifier: BSD-3-Clause
// Which message and service types this build knows. They come from meta/messages.txt and meta/services.txt.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bubblesim/messages/message_type.hpp"

namespace bubblesim::messages {

/// The type of that name (`pkg/Type`, also `pkg/msg/Type`), or nullptr when it is not listed. Halves of services are
/// found, too (`std_srvs/SetBoolRequest`). Thread-safe.
const MessageType* find_message(std::string_view name);

/// The service of that name (`pkg/Type`, also `pkg/srv/Type`), or nullptr when it is not listed. Thread-safe.
const ServiceType* find_service(std::string_view name);

/// Names of all listed types, sorted; types that only occur nested in others are included, halves of services are not.
std::vector<std::string> message_names();
std::vector<std::string> service_names();

/// Listed names that look like `name`, best first, at most three: for "did you mean".
std::vector<std::string> similar_message_names(std::string_view name);
std::vector<std::string> similar_service_names(std::string_view name);

/// Index of a field name, the same for the same name throughout the process; counts up from 0. Thread-safe.
std::uint32_t field_key(std::string_view name);

}  // namespace bubblesim::messages
