// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/callback_queue_interface.h>

#include <memory>
#include <set>
#include <string>

#include "bubblesim/messages/bridge.hpp"
#include "callback_guard.hpp"
#include "peers/publisher_check.hpp"
#include "topic_endpoints.hpp"
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
                 const messages::Qos& qos, messages::MessageCallback callback);
  void yield_topic(messages::EndpointId id);
  bool wants_messages(messages::EndpointId publisher) const;
  bool has_publisher(messages::EndpointId subscriber) const;
  WaitingCount waiting(messages::EndpointId subscriber) const;
  bool has_subscriber(messages::EndpointId id) const { return endpoints_.subscribers.count(id) != 0; }
  const messages::MessageType& type(messages::EndpointId id) const { return endpoints_.type(id); }
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
  /// Registers the endpoints that yield on this topic, or takes them off.
  void settle(const std::string& topic);
  void put_on(std::shared_ptr<PublisherEndpoint> publisher);
  void put_on(std::shared_ptr<SubscriberEndpoint> subscriber);
  void take_off(std::shared_ptr<PublisherEndpoint> publisher);
  void take_off(std::shared_ptr<SubscriberEndpoint> subscriber);

  MasterThread& master_;
  PublisherCheck& publisher_check_;
  ros::CallbackQueueInterface& queue_;
  CallbackGuard& guard_;
  TopicEndpoints<PublisherEndpoint, SubscriberEndpoint> endpoints_;  // what is off is not registered
  std::set<std::shared_ptr<SubscriberEndpoint>> registered_;         // of the master thread
};

}  // namespace bubblesim
