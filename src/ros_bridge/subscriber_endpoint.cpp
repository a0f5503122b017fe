// SPDX-License-Identifier: BSD-3-Clause
#include <ros/subscribe_options.h>
#include <ros/subscription_callback_helper.h>
#include <ros/topic_manager.h>

#include <typeinfo>
#include <vector>

#include "endpoints.hpp"

namespace bubblesim {
namespace {

// roscpp asks one subscription of a topic to read a message and gives the result to all whose getTypeInfo() is equal:
// so all share one copy of the bytes.
struct RawMessage {
  std::vector<std::uint8_t> bytes;
};

}  // namespace

class SubscriberEndpoint::Receiver final : public ros::SubscriptionCallbackHelper {
 public:
  Receiver(messages::MessageCallback callback, bool has_header, CallbackGuard& guard)
      : callback_(std::make_shared<messages::MessageCallback>(std::move(callback))),
        has_header_(has_header),
        guard_(guard) {}

  // Scripts' callbacks must die on the simulation's thread, while roscpp may drop this object on any other.
  void silence() { callback_.reset(); }

  ros::VoidConstPtr deserialize(const ros::SubscriptionCallbackHelperDeserializeParams& params) override {
    return boost::make_shared<RawMessage>(
        RawMessage{std::vector<std::uint8_t>(params.buffer, params.buffer + params.length)});
  }

  void call(ros::SubscriptionCallbackHelperCallParams& params) override {
    const std::shared_ptr<messages::MessageCallback> callback = callback_;  // it may silence itself
    if (!callback) return;
    const auto message = boost::static_pointer_cast<const RawMessage>(params.event.getConstMessage());
    guard_.run([&] { (*callback)(messages::WireView(message->bytes.data(), message->bytes.size())); });
  }

  const std::type_info& getTypeInfo() override { return typeid(RawMessage); }
  bool isConst() override { return true; }
  bool hasHeader() override { return has_header_; }

 private:
  std::shared_ptr<messages::MessageCallback> callback_;
  const bool has_header_;
  CallbackGuard& guard_;
};

SubscriberEndpoint::SubscriberEndpoint(std::string topic, const messages::MessageType& type, std::uint32_t queue_size,
                                       messages::MessageCallback callback, ros::CallbackQueueInterface& queue,
                                       CallbackGuard& guard)
    : topic_(std::move(topic)),
      type_(type),
      queue_size_(queue_size),
      queue_(queue),
      receiver_(boost::make_shared<Receiver>(std::move(callback), type.has_header, guard)) {}

void SubscriberEndpoint::silence() { receiver_->silence(); }

void SubscriberEndpoint::register_at_master() {
  ros::SubscribeOptions options(topic_, queue_size_, type_.md5, type_.name);
  options.helper = receiver_;
  options.callback_queue = &queue_;
  options.transport_hints = ros::TransportHints().tcpNoDelay();
  ros::TopicManager::instance()->subscribe(options);
}

void SubscriberEndpoint::unregister_from_master() { ros::TopicManager::instance()->unsubscribe(topic_, receiver_); }

}  // namespace bubblesim
