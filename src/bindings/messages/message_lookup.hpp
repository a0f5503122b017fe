// SPDX-License-Identifier: BSD-3-Clause
// Message types by name, for Python callers.
#pragma once

#include <string>

#include "bubblesim/messages/message_type.hpp"

namespace bubblesim::bindings {

/// Returns the type of that name in a version of ROS. Adds an unlisted type from its definition on this machine. Raises
/// MessageError (as pybind11::error_already_set) that suggests similar types and how to add one.
const messages::MessageType& listed_message(const std::string& name,
                                            messages::RosVersion version = messages::RosVersion::kRos1);
const messages::ServiceType& listed_service(const std::string& name,
                                            messages::RosVersion version = messages::RosVersion::kRos1);

}  // namespace bubblesim::bindings
