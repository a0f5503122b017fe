// SPDX-License-Identifier: BSD-3-Clause
// The types of the node's own topics and services, from roscpp's generated headers.
#pragma once

#include "bubblesim/messages/message_type.hpp"

namespace bubblesim {

const messages::MessageType& clock_type();
const messages::ServiceType& empty_service();

}  // namespace bubblesim
