// SPDX-License-Identifier: BSD-3-Clause
// The network's part of calling a service, on raw bytes. It is not roscpp's: that waits without limit, keeps the
// server's error text to itself, and holds a lock that stops all services while the master does not answer.
//
// All of it blocks: as long as `deadline` lasts, or, because calls to the master know no time limit, even longer.
#pragma once

#include <string>

#include "bubblesim/messages/bridge.hpp"
#include "master/deadline.hpp"

namespace bubblesim {

/// Throws messages::ServiceError, TimedSocket::TimedOut.
messages::WireBuffer call_service(const std::string& name, const messages::ServiceType& type,
                                  messages::WireBuffer request, const Deadline& deadline);

/// Whether a server takes connections for the service. A master that is not there counts as one that knows no service.
bool find_service(const std::string& name, const Deadline& deadline);

/// That a service is not `wanted` but of type `name`, with that md5.
messages::ServiceError other_type(const std::string& service, const std::string& name, const std::string& md5,
                                  const messages::ServiceType& wanted);

}  // namespace bubblesim
