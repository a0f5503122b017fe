// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/callback_queue_interface.h>

#include <memory>
#include <set>
#include <string>
#include <unordered_map>

#include "bubblesim/messages/bridge.hpp"
#include "callback_guard.hpp"
#include "endpoint_table.hpp"
#include "peers/publisher_check.hpp"
#include "topics/endpoints.hpp"

namespace bubblesim {

class MasterThread;

/// The publishers and subscribers of a node; see messages::Bridge. Everything belongs to the simulation thread unless
/// stated otherwise.
class Topics {
 public:
  /// Messages arrive through `queue`. All arguments must outlive the jobs posted to `master`.
  Topics(MasterThread& master, PublisherCheck& check, ros::CallbackQueueInterface& queue, CallbackGuard& guard)
      : master_(master), publisher_check_(check), queue_(queue), guard_(guard) {}

  /// `topic` is a full name. Throws std::invalid_argument if it has another type in this node.
  void advertise(messages::EndpointId id, const std::string& topic, const messages::MessageType& type,
                 std::uint32_t queue_size, bool latch);
  void subscribe(messages::EndpointId id, const std::string& topic, const messages::MessageType& type,
                 std::uint32_t queue_size, messages::MessageCallback callback, bool tcp_no_delay);
  void yield_topic(messages::EndpointId id);
  bool wants_messages(messages::EndpointId publisher) const;
  bool has_publisher(messages::EndpointId subscriber) const;
  WaitingCount waiting(messages::EndpointId subscriber) const;
  bool has_subscriber(messages::EndpointId id) const { return subscribers_.count(id) != 0; }
  const messages::MessageType& type(messages::EndpointId id) const;
  void publish(messages::EndpointId publisher, messages::WireBuffer message);
  void shutdown_publisher(messages::EndpointId publisher);
  void shutdown_subscriber(messages::EndpointId subscriber);

  /// Number of publishers on a topic.
  std::size_t publishers_on(const std::string& topic) const;
  /// On the master thread: updates has_publisher().
  void look_for_publishers();
  /// Shuts down all publishers and subscribers.
  void shutdown_all();
  /// Silences all subscribers, for the end of the bridge.
  void silence();

 private:
  /// Returns whether it was off.
  bool forget_yielding(messages::EndpointId id);
  void check_type_on(const std::string& topic, const messages::MessageType& type) const;
  void settle(const std::string& topic);
  template <class Endpoint>
  void settle(EndpointTable<Endpoint>& own_kind, const std::string& topic);
  template <class Endpoint>
  bool has_script(const EndpointTable<Endpoint>& endpoints, const std::string& topic,
                  const messages::MessageType* other_than) const;
  void put_on(std::shared_ptr<PublisherEndpoint> publisher);
  void put_on(std::shared_ptr<SubscriberEndpoint> subscriber);
  void take_off(std::shared_ptr<PublisherEndpoint> publisher);
  void take_off(std::shared_ptr<SubscriberEndpoint> subscriber);

  MasterThread& master_;
  PublisherCheck& publisher_check_;
  ros::CallbackQueueInterface& queue_;
  CallbackGuard& guard_;
  EndpointTable<PublisherEndpoint> publishers_;
  EndpointTable<SubscriberEndpoint> subscribers_;
  /// The endpoints that yield, and whether each is off: not registered, because its topic currently has another type.
  std::unordered_map<messages::EndpointId, bool> yielding_;
  std::set<std::shared_ptr<SubscriberEndpoint>> registered_;  // of the master thread
};

/// Throws std::invalid_argument if the topic is already `done` with another type.
void check_same_type(const std::string& topic, const messages::MessageType& type, const char* done,
                     const messages::MessageType& other);

}  // namespace bubblesim
