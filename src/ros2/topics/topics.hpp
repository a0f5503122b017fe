// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <string>

#include "bubblesim/messages/bridge.hpp"
#include "topic_endpoints.hpp"
#include "topics/endpoints.hpp"

namespace bubblesim::ros2 {

/// The publishers and subscribers of a node; see messages::Bridge. Names are full ones. For the simulation's thread.
class Topics {
 public:
  Topics(Participant& participant, Inbox& inbox, Outbox& outbox, Traffic& traffic)
      : participant_(participant), inbox_(inbox), outbox_(outbox), traffic_(traffic) {}

  /// Throws std::invalid_argument if the topic has another type in this node.
  void advertise(messages::EndpointId id, const std::string& topic, const messages::MessageType& type,
                 const messages::Qos& qos);
  void subscribe(messages::EndpointId id, const std::string& topic, const messages::MessageType& type,
                 const messages::Qos& qos, messages::MessageCallback callback);
  void yield_topic(messages::EndpointId id);
  const PublisherEndpoint& publisher(messages::EndpointId id) const;
  const SubscriberEndpoint& subscriber(messages::EndpointId id) const;
  bool has_subscriber(messages::EndpointId id) const { return endpoints_.subscribers.count(id) != 0; }
  const messages::MessageType& type(messages::EndpointId id) const { return endpoints_.type(id); }
  void publish(messages::EndpointId publisher, messages::WireBuffer message);
  void shutdown_publisher(messages::EndpointId publisher);
  void shutdown_subscriber(messages::EndpointId subscriber);
  /// Shuts down the endpoints with this id and later ones.
  void shutdown_from(messages::EndpointId first);

 private:
  /// Opens the endpoints that yield on this topic, or closes them.
  void settle(const std::string& topic);
  /// Until when a publisher that shuts down waits for its subscribers. All that do so within a second have the same
  /// end: the end of a script or node with many takes no longer.
  std::chrono::steady_clock::time_point end_of_delivery();

  Participant& participant_;
  Inbox& inbox_;
  Outbox& outbox_;
  Traffic& traffic_;
  std::chrono::steady_clock::time_point first_delivery_;
  TopicEndpoints<PublisherEndpoint, SubscriberEndpoint> endpoints_;  // what is off is closed
};

}  // namespace bubblesim::ros2
