// SPDX-License-Identifier: BSD-3-Clause
#include "services/service_server.hpp"

#include <ros/advertise_service_options.h>
#include <ros/service_manager.h>
#include <ros/service_publication.h>

#include <atomic>
#include <cstring>
#include <limits>
#include <utility>

#include "service_answer.hpp"

namespace bubblesim {
namespace {

using messages::ServiceCallback;
using messages::ServiceError;
using messages::WireBuffer;
using messages::WireView;

/// Counts an answer in progress.
class Answering {
 public:
  explicit Answering(std::atomic<int>& count) : count_(count) { ++count_; }
  ~Answering() { --count_; }
  Answering(const Answering&) = delete;
  Answering& operator=(const Answering&) = delete;

 private:
  std::atomic<int>& count_;
};

/// The TCPROS form: one byte for success, the length, the bytes.
ros::SerializedMessage to_response(const WireBuffer& message) {
  constexpr std::size_t kBefore = 1 + sizeof(std::uint32_t);
  if (message.size() > std::numeric_limits<std::uint32_t>::max() - kBefore) {
    throw ServiceError("the response has 4 GiB or more");
  }
  const auto length = static_cast<std::uint32_t>(message.size());
  boost::shared_array<std::uint8_t> bytes(new std::uint8_t[kBefore + length]);
  bytes[0] = 1;
  std::memcpy(bytes.get() + 1, &length, sizeof(length));
  if (length != 0) std::memcpy(bytes.get() + kBefore, message.data(), length);
  return {bytes, kBefore + length};
}

}  // namespace

class ServiceServer::Responder final : public ros::ServiceCallbackHelper {
 public:
  Responder(ServiceCallback callback, ros::CallbackQueueInterface& queue_to_use, CallbackGuard& guard)
      : queue(queue_to_use), callback_(std::make_shared<ServiceCallback>(std::move(callback))), guard_(guard) {}

  // Callbacks of scripts must be destroyed on the simulation thread, while roscpp may release this object on any other.
  void silence() { callback_.reset(); }

  WireBuffer answer(WireView request) {
    const Answering answering(answering_);
    return answer_request(callback_, guard_, request);
  }

  bool is_answering() const { return answering_ > 0; }

  /// roscpp logs the exceptions of this function and sends their text to the caller.
  bool call(ros::ServiceCallbackHelperCallParams& params) override {
    params.response = to_response(answer(WireView(params.request.buf.get(), params.request.num_bytes)));
    return true;
  }

  CountingQueue queue;  // here, because roscpp keeps this object as long as it uses the queue

 private:
  std::shared_ptr<ServiceCallback> callback_;
  CallbackGuard& guard_;
  std::atomic<int> answering_{0};  // answers in progress: more than one if a service calls itself
};

ServiceServer::ServiceServer(std::string name, const messages::ServiceType& type, ServiceCallback callback,
                             ros::CallbackQueueInterface& queue, CallbackGuard& guard)
    : name_(std::move(name)),
      type_(type),
      responder_(boost::make_shared<Responder>(std::move(callback), queue, guard)) {}

WireBuffer ServiceServer::answer(WireView request) { return responder_->answer(request); }

WaitingCount ServiceServer::waiting() const { return responder_->queue.waiting(); }

bool ServiceServer::is_answering() const { return responder_->is_answering(); }

void ServiceServer::silence() { responder_->silence(); }

void ServiceServer::register_at_master() {
  ros::AdvertiseServiceOptions options;
  options.service = name_;
  options.md5sum = type_.type_hash;
  options.datatype = type_.name;
  options.req_datatype = type_.request->name;
  options.res_datatype = type_.response->name;
  options.helper = responder_;
  options.callback_queue = &responder_->queue;
  const auto& services = ros::ServiceManager::instance();
  if (services->advertiseService(options)) publication_ = services->lookupServicePublication(name_);
}

ros::ServicePublicationPtr ServiceServer::unregister_from_master() {
  if (publication_) ros::ServiceManager::instance()->unadvertiseService(name_);
  return std::exchange(publication_, nullptr);
}

}  // namespace bubblesim
