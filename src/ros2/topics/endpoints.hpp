// SPDX-License-Identifier: BSD-3-Clause
// One publisher or subscriber of a script or plugin. All functions are for the simulation's thread.
#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <string>

#include "bubblesim/messages/bridge.hpp"
#include "dds/participant.hpp"
#include "topics/inbox.hpp"
#include "topics/outbox.hpp"

namespace bubblesim::ros2 {

class PublisherEndpoint {
 public:
  PublisherEndpoint(std::string topic, const messages::MessageType& type, const messages::Qos& qos, Outbox& outbox);
  ~PublisherEndpoint();
  PublisherEndpoint(const PublisherEndpoint&) = delete;
  PublisherEndpoint& operator=(const PublisherEndpoint&) = delete;

  const std::string& topic() const { return topic_; }
  const messages::MessageType& type() const { return type_; }
  bool wants_messages() const { return !aside_ && outgoing_ && (qos_.transient_local || subscribers_ > 0); }
  int subscribers() const { return subscribers_; }
  /// While it is aside, it publishes nothing.
  void set_aside(bool aside) { aside_ = aside; }
  /// Only for a publisher that wants messages.
  void publish(messages::WireBuffer message);

  void open(Participant& participant);
  /// Waits until reliable subscribers have all messages, or until `end`, which is less than a second away.
  void deliver(std::chrono::steady_clock::time_point end);
  /// Messages that are not delivered by then are lost.
  void close();

 private:
  class Listener;

  const std::string topic_;
  const messages::MessageType& type_;
  const messages::Qos qos_;
  Outbox& outbox_;
  bool aside_ = false;
  std::atomic<int> subscribers_{0};
  std::unique_ptr<Listener> listener_;
  std::unique_ptr<Writer> writer_;      // null while it is closed
  std::shared_ptr<Outgoing> outgoing_;  // likewise
};

class SubscriberEndpoint {
 public:
  SubscriberEndpoint(std::string topic, const messages::MessageType& type, const messages::Qos& qos,
                     messages::MessageCallback callback, Inbox& inbox);
  ~SubscriberEndpoint();
  SubscriberEndpoint(const SubscriberEndpoint&) = delete;
  SubscriberEndpoint& operator=(const SubscriberEndpoint&) = delete;

  const std::string& topic() const { return topic_; }
  const messages::MessageType& type() const { return type_; }
  bool has_publisher() const { return publishers_ > 0; }
  const std::shared_ptr<Mailbox>& mailbox() const { return mailbox_; }
  /// While it is aside, it delivers nothing.
  void set_aside(bool aside) { mailbox_->aside = aside; }
  /// Destroys the callback, at once or when a running call returns.
  void silence() { mailbox_->callback = nullptr; }

  void open(Participant& participant);
  void close();

 private:
  class Listener;

  const std::string topic_;
  const messages::MessageType& type_;
  const messages::Qos qos_;
  const std::shared_ptr<Mailbox> mailbox_ = std::make_shared<Mailbox>();
  Inbox& inbox_;
  std::atomic<int> publishers_{0};
  std::unique_ptr<Listener> listener_;
  std::unique_ptr<Reader> reader_;  // null while it is closed
};

}  // namespace bubblesim::ros2
