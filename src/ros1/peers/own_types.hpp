// SPDX-License-Identifier: BSD-3-Clause
// The types of what the node itself publishes and offers, as roscpp's generated headers tell them.
#pragma once

#include "bubblesim/messages/message_type.hpp"

namespace bubblesim {

const messages::MessageType& clock_type();
const messages::ServiceType& empty_service();

}  // namespace bubblesim
