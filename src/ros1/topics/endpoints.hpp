// SPDX-License-Identifier: BSD-3-Clause
// One publisher or subscriber of a script, as roscpp sees it: raw bytes under the type's name and md5.
//
// They stand on roscpp's TopicManager rather than on ros::NodeHandle: every ros::Publisher::publish() takes a lock that
// roscpp holds during calls to the master, so a master that hangs would stop the simulation; and no C++ message class
// exists for the bytes that step here.
//
// register_*/unregister_* belong to the master thread, everything else to the simulation's thread.
#pragma once

#include <ros/forwards.h>
#include <ros/serialized_message.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <string>

#include "bubblesim/messages/bridge.hpp"
#include "status/counting_queue.hpp"
#include "topics/callback_guard.hpp"

namespace bubblesim {

class PublisherEndpoint {
 public:
  PublisherEndpoint(std::string topic, const messages::MessageType& type, std::uint32_t queue_size, bool latch);
  /// One to register in its place; what this one latched is not in it.
  std::shared_ptr<PublisherEndpoint> unregistered_copy() const;

  const std::string& topic() const { return topic_; }
  const messages::MessageType& type() const { return type_; }
  bool wants_messages() const { return latch_ || has_subscribers(); }
  /// How many are connected, one of this node itself included.
  std::size_t subscribers() const;
  void publish(messages::WireBuffer message);

  void register_at_master();
  void unregister_from_master();

 private:
  struct Latch {
    std::mutex mutex;
    ros::SerializedMessage message;
  };

  bool has_subscribers() const;
  void send(ros::SerializedMessage message);

  const std::string topic_;
  const messages::MessageType& type_;
  const std::uint32_t queue_size_;
  const std::shared_ptr<Latch> latch_;  // null: does not latch; shared with roscpp's network thread
  ros::SubscriberCallbacksPtr callbacks_;
  ros::PublicationPtr publication_;  // set by the master thread, then announced by registered_
  std::atomic<bool> registered_{false};
};

class SubscriberEndpoint {
 public:
  /// Callbacks run through `guard` when `queue` is called.
  SubscriberEndpoint(std::string topic, const messages::MessageType& type, std::uint32_t queue_size,
                     messages::MessageCallback callback, bool tcp_no_delay, ros::CallbackQueueInterface& queue,
                     CallbackGuard& guard);

  const std::string& topic() const { return topic_; }
  const messages::MessageType& type() const { return type_; }
  /// Messages that have come and not been delivered yet.
  WaitingCount waiting() const;
  /// From here on the callback is not called any more; it is destroyed here, or when it returns if it is running.
  void silence();

  void register_at_master();
  void unregister_from_master();

  /// Whether one was connected when look_for_publisher() was called.
  bool has_publisher() const { return has_publisher_; }
  /// For the master thread: roscpp counts under a lock that it holds during calls to the master.
  void look_for_publisher();

 private:
  class Receiver;

  const std::string topic_;
  const messages::MessageType& type_;
  const std::uint32_t queue_size_;
  const bool tcp_no_delay_;
  const boost::shared_ptr<Receiver> receiver_;
  std::atomic<bool> has_publisher_{false};
};

}  // namespace bubblesim
