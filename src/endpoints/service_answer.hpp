// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <memory>
#include <optional>
#include <string>

#include "bubblesim/messages/bridge.hpp"
#include "callback_guard.hpp"

namespace bubblesim {

/// Calls the callback of a service, which may shut down the service meanwhile. What it throws becomes a ServiceError;
/// unless it was one, the guard rethrows it later, too. A null callback is that of a service that was shut down.
inline messages::WireBuffer answer_request(std::shared_ptr<messages::ServiceCallback> callback, CallbackGuard& guard,
                                           messages::WireView request) {
  if (!callback) throw messages::ServiceError("the service was shut down");
  messages::WireBuffer response;
  std::optional<std::string> failure;
  guard.run([&] {
    try {
      response = (*callback)(request);
    } catch (const messages::ServiceError& error) {
      failure = error.what();
    } catch (const std::exception& error) {
      failure = error.what();
      throw;
    } catch (...) {
      failure = "unknown error";
      throw;
    }
  });
  if (failure) throw messages::ServiceError(*failure);
  return response;
}

}  // namespace bubblesim
