// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/forwards.h>

#include <memory>
#include <string>

#include "bubblesim/messages/bridge.hpp"
#include "callback_guard.hpp"
#include "callbacks/counting_queue.hpp"

namespace bubblesim {

/// A script's service for roscpp: raw bytes with the type's name and md5. Call register_* and unregister_* on the
/// master thread, everything else on the simulation thread.
class ServiceServer {
 public:
  /// Callbacks run when `queue` is served; `guard` keeps their exceptions except ServiceError.
  ServiceServer(std::string name, const messages::ServiceType& type, messages::ServiceCallback callback,
                ros::CallbackQueueInterface& queue, CallbackGuard& guard);

  const std::string& name() const { return name_; }
  const messages::ServiceType& type() const { return type_; }
  /// Calls the callback. Throws ServiceError with the text of any exception.
  messages::WireBuffer answer(messages::WireView request);
  /// Number of pending requests.
  WaitingCount waiting() const;
  /// Whether the callback is running.
  bool is_answering() const;
  /// Stops calls of the callback and destroys it, at once or when a running call returns.
  void silence();

  void register_at_master();
  /// Returns roscpp's object of the service. roscpp's network thread aborts the process if a request arrives during its
  /// destruction, so the caller must keep it for a while.
  ros::ServicePublicationPtr unregister_from_master();

 private:
  class Responder;

  const std::string name_;
  const messages::ServiceType& type_;
  const boost::shared_ptr<Responder> responder_;
  ros::ServicePublicationPtr publication_;
};

}  // namespace bubblesim
