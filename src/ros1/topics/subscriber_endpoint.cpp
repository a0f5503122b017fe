// SPDX-License-Identifier: BSD-3-Clause
#include <ros/subscribe_options.h>
#include <ros/subscription_callback_helper.h>
#include <ros/this_node.h>
#include <ros/topic_manager.h>

#include <typeinfo>

#include "topics/endpoints.hpp"

namespace bubblesim {
namespace {

/// A distinct type for each subscriber: roscpp deserializes a message once for all subscribers of equal type on a
/// topic, but here each subscriber reads it.
class OwnType final : public std::type_info {
 public:
  OwnType() : std::type_info(name_) {}

 private:
  const char name_[2] = "*";  // for names that begin with a star, type_info compares the addresses of the names
};

}  // namespace

class SubscriberEndpoint::Receiver final : public ros::SubscriptionCallbackHelper {
 public:
  Receiver(messages::MessageCallback callback, bool has_header, bool ignore_own,
           ros::CallbackQueueInterface& queue_to_use, CallbackGuard& guard)
      : queue(queue_to_use),
        callback_(std::make_shared<messages::MessageCallback>(std::move(callback))),
        has_header_(has_header),
        ignore_own_(ignore_own),
        guard_(guard) {}

  // Callbacks of scripts must be destroyed on the simulation thread, while roscpp may release this object on any other.
  void silence() { callback_.reset(); }
  void set_aside(bool aside) { aside_ = aside; }

  /// Passes the bytes in roscpp's buffer, which exists during this call: avoids a copy of large messages. It runs where
  /// roscpp would call the callback just after.
  ros::VoidConstPtr deserialize(const ros::SubscriptionCallbackHelperDeserializeParams& params) override {
    const std::shared_ptr<messages::MessageCallback> callback = callback_;  // the callback may call silence()
    if (ignore_own_ && is_own(params)) return nullptr;
    if (callback && !aside_) guard_.run([&] { (*callback)(messages::WireView(params.buffer, params.length)); });
    return nullptr;
  }

  /// Only called with the result of deserialize(), which is empty.
  void call(ros::SubscriptionCallbackHelperCallParams& /*params*/) override {}

  const std::type_info& getTypeInfo() override { return type_; }
  bool isConst() override { return true; }
  bool hasHeader() override { return has_header_; }

  CountingQueue queue;  // here, because roscpp keeps this object as long as it uses the queue

 private:
  static bool is_own(const ros::SubscriptionCallbackHelperDeserializeParams& params) {
    if (!params.connection_header) return false;
    const auto publisher = params.connection_header->find("callerid");
    return publisher != params.connection_header->end() && publisher->second == ros::this_node::getName();
  }

  std::shared_ptr<messages::MessageCallback> callback_;
  bool aside_ = false;
  const bool has_header_;
  const bool ignore_own_;
  CallbackGuard& guard_;
  const OwnType type_;
};

SubscriberEndpoint::SubscriberEndpoint(std::string topic, const messages::MessageType& type, const messages::Qos& qos,
                                       messages::MessageCallback callback, ros::CallbackQueueInterface& queue,
                                       CallbackGuard& guard)
    : topic_(std::move(topic)),
      type_(type),
      qos_(qos),
      receiver_(boost::make_shared<Receiver>(std::move(callback), type.has_header, qos.ignore_own, queue, guard)) {}

WaitingCount SubscriberEndpoint::waiting() const { return receiver_->queue.waiting(); }

void SubscriberEndpoint::set_aside(bool aside) { receiver_->set_aside(aside); }

void SubscriberEndpoint::silence() { receiver_->silence(); }

void SubscriberEndpoint::register_at_master() {
  ros::SubscribeOptions options(topic_, qos_.depth, type_.type_hash, type_.name);
  options.helper = receiver_;
  options.callback_queue = &receiver_->queue;
  options.transport_hints = ros::TransportHints().tcpNoDelay(qos_.tcp_no_delay);
  ros::TopicManager::instance()->subscribe(options);
}

void SubscriberEndpoint::look_for_publisher() {
  has_publisher_ = ros::TopicManager::instance()->getNumPublishers(topic_) > 0;
}

void SubscriberEndpoint::unregister_from_master() { ros::TopicManager::instance()->unsubscribe(topic_, receiver_); }

}  // namespace bubblesim
