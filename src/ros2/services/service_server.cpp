// SPDX-License-Identifier: BSD-3-Clause
#include "services/service_server.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "bubblesim/messages/fields.hpp"
#include "graph/names.hpp"
#include "service_answer.hpp"

namespace bubblesim::ros2 {
namespace {

using messages::MessageType;
using messages::ServiceError;
using messages::WireBuffer;
using messages::WireView;

/// The response of a service that has failed: its fields for that, if it has some. ROS 2 has no other way to say why.
class Failure final : public messages::FieldReader {
 public:
  explicit Failure(std::string why) : why_(std::move(why)) {}

  static bool fits(const MessageType& type) {
    return std::any_of(type.fields.begin(), type.fields.end(), [](const messages::Field& field) {
      return field.name == "success" && field.kind == messages::FieldKind::kBool;
    });
  }
  void read(messages::Fields& fields) const override {
    fields.put("success", false);
    fields.put("message", std::string_view(why_));
    fields.put("status_message", std::string_view(why_));
  }

 private:
  const std::string why_;
};

}  // namespace

class ServiceServer::Listener final : public dds::DataReaderListener {
 public:
  Listener(RequestQueue& queue, std::shared_ptr<Responder> responder)
      : queue_(queue), responder_(std::move(responder)) {}

  void on_data_available(dds::DataReader* reader) override {
    std::vector<std::uint8_t> message;
    dds::SampleInfo info;
    while (take(*reader, message, info)) {
      RequestId id;
      if (!info.valid_data || !read_request_id(info, message, id)) continue;
      ++*responder_->waiting;
      queue_.add([responder = responder_, id, request = std::exchange(message, {})] {
        --*responder->waiting;
        responder->reply(id, WireView(request.data(), request.size()));
      });
    }
  }

 private:
  RequestQueue& queue_;
  const std::shared_ptr<Responder> responder_;
};

ServiceServer::ServiceServer(Participant& participant, std::string name, const messages::ServiceType& type,
                             messages::ServiceCallback callback, RequestQueue& queue, CallbackGuard& guard,
                             LateReplies& late, Rosout& log)
    : ServiceServer(participant, std::make_shared<Responder>(participant, std::move(name), type, guard, late, log),
                    queue) {
  responder_->callback = std::make_shared<messages::ServiceCallback>(std::move(callback));
}

ServiceServer::ServiceServer(Participant& participant, std::string name, const messages::ServiceType& type,
                             messages::RequestCallback on_request, RequestQueue& queue, CallbackGuard& guard,
                             LateReplies& late, Rosout& log)
    : ServiceServer(participant, std::make_shared<Responder>(participant, std::move(name), type, guard, late, log),
                    queue) {
  responder_->on_request = std::make_shared<messages::RequestCallback>(std::move(on_request));
}

ServiceServer::ServiceServer(Participant& participant, std::shared_ptr<Responder> responder, RequestQueue& queue)
    : name_(responder->name),
      type_(responder->type),
      queue_(queue),
      responder_(std::move(responder)),
      listener_(std::make_unique<Listener>(queue, responder_)),
      requests_(std::make_unique<Reader>(participant, request_topic(name_, type_), messages::Qos(), listener_.get())) {}

ServiceServer::Responder::Responder(Participant& participant, std::string service,
                                    const messages::ServiceType& its_type, CallbackGuard& its_guard,
                                    LateReplies& its_late, Rosout& its_log)
    : name(std::move(service)),
      type(its_type),
      guard(its_guard),
      late(its_late),
      log(its_log),
      replies(std::make_shared<ReplyWriter>(participant, reply_topic(name, type), messages::Qos(), its_late)) {}

ServiceServer::~ServiceServer() {
  requests_.reset();
  responder_->late.keep(responder_->replies);
}

WireBuffer ServiceServer::Responder::answer(WireView request) { return answer_request(callback, guard, request); }

void ServiceServer::Responder::reply(const RequestId& id, WireView request) {
  if (on_request) {
    const auto called = on_request;  // the callback may shut down the service
    unanswered.emplace(++last_number, id);
    guard.run([&] { (*called)(last_number, request); });
    return;
  }
  if (!callback) return;  // shut down since the request arrived
  WireBuffer response;
  try {
    response = answer(request);
  } catch (const ServiceError& error) {
    log.log(Rosout::Level::kError, "service '" + name + "' failed: " + error.what());
    response = WireBuffer();
    response.begin(messages::Layout::kCdr);
    if (Failure::fits(*type.response)) {
      messages::encode(*type.response, Failure(error.what()), response);
    } else {
      put_default(*type.response, response);
    }
  }
  replies->send(id, std::move(response));
}

void ServiceServer::reply(messages::RequestNumber number, WireBuffer response) {
  const auto request = responder_->unanswered.find(number);
  if (request == responder_->unanswered.end()) return;
  responder_->replies->send(request->second, std::move(response));
  responder_->unanswered.erase(request);
}

}  // namespace bubblesim::ros2
