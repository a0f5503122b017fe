// SPDX-License-Identifier: BSD-3-Clause
// The network part of service calls, on raw bytes. It replaces roscpp's, which waits without limit, does not return the
// server's error text, and holds a lock that stops all services while the master does not answer.
//
// All functions block until `deadline`, or longer, because calls to the master have no time limit.
#pragma once

#include <atomic>
#include <string>

#include "bubblesim/messages/bridge.hpp"
#include "master/deadline.hpp"

namespace bubblesim {

/// Sets `found` once the master has answered. Throws messages::ServiceError, TimedSocket::TimedOut.
messages::WireBuffer call_service(const std::string& name, const messages::ServiceType& type,
                                  messages::WireBuffer request, const Deadline& deadline, std::atomic<bool>& found);

/// Returns whether a server of the service accepts connections; false without a master.
bool find_service(const std::string& name, const Deadline& deadline);

/// Returns the type that the server of a service reports, `pkg/Type`; empty without an answer.
std::string type_of_service(const std::string& name, const Deadline& deadline);

/// The error that a service is of type `name` with that md5, not `wanted`.
messages::ServiceError other_type(const std::string& service, const std::string& name, const std::string& md5,
                                  const messages::ServiceType& wanted);

}  // namespace bubblesim
