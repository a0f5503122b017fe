// SPDX-License-Identifier: BSD-3-Clause
// One publisher or subscriber of a script, for roscpp: raw bytes with the type's name and md5.
//
// They use roscpp's TopicManager instead of ros::NodeHandle: every ros::Publisher::publish() takes a lock that roscpp
// holds during calls to the master, so a master that hangs would stop the simulation; and the bytes that are sent here
// have no C++ message class.
//
// Call register_*/unregister_* on the master thread, everything else on the simulation thread.
#pragma once

#include <ros/forwards.h>
#include <ros/serialized_message.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <string>

#include "bubblesim/messages/bridge.hpp"
#include "callback_guard.hpp"
#include "callbacks/counting_queue.hpp"

namespace bubblesim {

class PublisherEndpoint {
 public:
  PublisherEndpoint(std::string topic, const messages::MessageType& type, std::uint32_t queue_size, bool latch);
  /// A copy to register as a replacement; without the latched message.
  std::shared_ptr<PublisherEndpoint> unregistered_copy() const;

  const std::string& topic() const { return topic_; }
  const messages::MessageType& type() const { return type_; }
  bool wants_messages() const { return !aside_ && (latch_ || has_subscribers()); }
  /// While it is aside, it publishes nothing.
  void set_aside(bool aside) { aside_ = aside; }
  /// Number of connected subscribers, including one of this node itself.
  std::size_t subscribers() const;
  void publish(messages::WireBuffer message);

  void register_at_master();
  /// Waits until the last messages are sent.
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
  bool aside_ = false;
  const std::shared_ptr<Latch> latch_;  // null if not latched; shared with roscpp's network thread
  ros::SubscriberCallbacksPtr callbacks_;
  ros::PublicationPtr publication_;  // set by the master thread, then announced by registered_
  std::atomic<bool> registered_{false};
  std::atomic<std::chrono::steady_clock::time_point> last_message_{};
};

/// Waits until roscpp has sent the last messages of all publishers. On the master thread.
void wait_until_all_are_sent();

class SubscriberEndpoint {
 public:
  /// Callbacks run through `guard` when `queue` is called.
  SubscriberEndpoint(std::string topic, const messages::MessageType& type, const messages::Qos& qos,
                     messages::MessageCallback callback, ros::CallbackQueueInterface& queue, CallbackGuard& guard);

  const std::string& topic() const { return topic_; }
  const messages::MessageType& type() const { return type_; }
  /// Number of pending messages.
  WaitingCount waiting() const;
  /// While it is aside, it delivers nothing.
  void set_aside(bool aside);
  /// Stops calls of the callback and destroys it, at once or when a running call returns.
  void silence();

  void register_at_master();
  void unregister_from_master();

  /// Whether a publisher was connected at the last look_for_publisher().
  bool has_publisher() const { return has_publisher_; }
  /// On the master thread: roscpp counts under a lock that it holds during calls to the master.
  void look_for_publisher();

 private:
  class Receiver;

  const std::string topic_;
  const messages::MessageType& type_;
  const messages::Qos qos_;
  const boost::shared_ptr<Receiver> receiver_;
  std::atomic<bool> has_publisher_{false};
};

}  // namespace bubblesim
