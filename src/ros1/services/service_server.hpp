// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/forwards.h>

#include <memory>
#include <string>

#include "bubblesim/messages/bridge.hpp"
#include "services/request_queue.hpp"
#include "status/counting_queue.hpp"
#include "topics/callback_guard.hpp"

namespace bubblesim {

/// A service of a script, as roscpp sees it: raw bytes under the type's name and md5. register_* and unregister_*
/// belong to the master thread, everything else to the simulation's.
class ServiceServer {
 public:
  /// Callbacks run when `queue` is served; what they throw, ServiceError excepted, goes to `guard`.
  ServiceServer(std::string name, const messages::ServiceType& type, messages::ServiceCallback callback,
                RequestQueue& queue, CallbackGuard& guard);

  const std::string& name() const { return name_; }
  const messages::ServiceType& type() const { return type_; }
  /// Calls the callback. Throws ServiceError with the text of whatever that throws.
  messages::WireBuffer answer(messages::WireView request);
  /// Requests that have come and not been answered yet, nor begun to be.
  WaitingCount waiting() const;
  /// Whether the callback is running.
  bool is_answering() const;
  /// From here on the callback is not called any more; it is destroyed here, or when it returns if it is running.
  void silence();

  void register_at_master();
  /// What roscpp keeps of the service. Its network thread aborts the process when a request comes in just as this is
  /// destroyed, so it has to be kept for a while.
  ros::ServicePublicationPtr unregister_from_master();

 private:
  class Responder;

  const std::string name_;
  const messages::ServiceType& type_;
  const boost::shared_ptr<Responder> responder_;
  ros::ServicePublicationPtr publication_;
};

}  // namespace bubblesim
