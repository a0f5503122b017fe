// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <string>

#include "bubblesim/messages/bridge.hpp"
#include "bubblesim/messages/later_services.hpp"
#include "callback_guard.hpp"
#include "dds/participant.hpp"
#include "graph/rosout.hpp"
#include "request_queue.hpp"
#include "services/reply_writer.hpp"

namespace bubblesim::ros2 {

/// A service of this node. Answers requests when `queue` is served.
class ServiceServer {
 public:
  ServiceServer(Participant& participant, std::string name, const messages::ServiceType& type,
                messages::ServiceCallback callback, RequestQueue& queue, CallbackGuard& guard, LateReplies& late,
                Rosout& log);
  /// A service that answers with reply().
  ServiceServer(Participant& participant, std::string name, const messages::ServiceType& type,
                messages::RequestCallback on_request, RequestQueue& queue, CallbackGuard& guard, LateReplies& late,
                Rosout& log);
  ~ServiceServer();
  ServiceServer(const ServiceServer&) = delete;
  ServiceServer& operator=(const ServiceServer&) = delete;

  const std::string& name() const { return name_; }
  const messages::ServiceType& type() const { return type_; }
  /// Answers a call of this node itself. Throws ServiceError.
  messages::WireBuffer answer(messages::WireView request) { return responder_->answer(request); }
  /// Whether the one who serves `queue` answers, and at once: only such a service can be called from there.
  bool is_answered_by(const RequestQueue& queue) const { return &queue == &queue_ && responder_->callback != nullptr; }
  /// Number of requests that wait. Thread-safe.
  const std::shared_ptr<std::atomic<int>>& waiting() const { return responder_->waiting; }
  /// Does nothing for a request that is answered already.
  void reply(messages::RequestNumber number, messages::WireBuffer response);
  /// Destroys the callback, at once or when a running call returns.
  void silence() {
    responder_->callback = nullptr;
    responder_->on_request = nullptr;
  }

 private:
  /// Kept by requests that wait in the queue.
  struct Responder {
    Responder(Participant& participant, std::string service, const messages::ServiceType& its_type,
              CallbackGuard& its_guard, LateReplies& its_late, Rosout& its_log);

    messages::WireBuffer answer(messages::WireView request);
    void reply(const RequestId& id, messages::WireView request);

    std::string name;
    const messages::ServiceType& type;
    CallbackGuard& guard;
    LateReplies& late;
    Rosout& log;
    std::shared_ptr<messages::ServiceCallback> callback;  // of the two callbacks, one is not null until it is shut down
    std::shared_ptr<messages::RequestCallback> on_request;
    std::map<messages::RequestNumber, RequestId> unanswered;  // of on_request
    messages::RequestNumber last_number = 0;
    std::shared_ptr<ReplyWriter> replies;
    std::shared_ptr<std::atomic<int>> waiting = std::make_shared<std::atomic<int>>(0);
  };
  class Listener;

  ServiceServer(Participant& participant, std::shared_ptr<Responder> responder, RequestQueue& queue);

  const std::string name_;
  const messages::ServiceType& type_;
  RequestQueue& queue_;
  const std::shared_ptr<Responder> responder_;
  std::unique_ptr<Listener> listener_;
  std::unique_ptr<Reader> requests_;
};

}  // namespace bubblesim::ros2
