// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <set>
#include <string>

#include "bubblesim/messages/bridge.hpp"
#include "endpoint_table.hpp"
#include "topics/endpoints.hpp"

namespace bubblesim::ros2 {

/// The publishers and subscribers of a node; see messages::Bridge. Names are full ones. For the simulation's thread.
class Topics {
 public:
  Topics(Participant& participant, Inbox& inbox) : participant_(participant), inbox_(inbox) {}

  /// Throws std::invalid_argument if the topic has another type in this node.
  void advertise(messages::EndpointId id, const std::string& topic, const messages::MessageType& type,
                 const messages::Qos& qos);
  void subscribe(messages::EndpointId id, const std::string& topic, const messages::MessageType& type,
                 const messages::Qos& qos, messages::MessageCallback callback);
  void yield_topic(messages::EndpointId id);
  const PublisherEndpoint& publisher(messages::EndpointId id) const;
  const SubscriberEndpoint& subscriber(messages::EndpointId id) const;
  bool has_subscriber(messages::EndpointId id) const { return subscribers_.count(id) != 0; }
  const messages::MessageType& type(messages::EndpointId id) const;
  void publish(messages::EndpointId publisher, messages::WireBuffer message);
  void shutdown_publisher(messages::EndpointId publisher);
  void shutdown_subscriber(messages::EndpointId subscriber);
  /// Shuts down the endpoints with this id and later ones.
  void shutdown_from(messages::EndpointId first);
  /// Number of publishers on a topic.
  std::size_t publishers_on(const std::string& topic) const;

 private:
  void check_type_on(const std::string& topic, const messages::MessageType& type) const;
  template <class Endpoint>
  bool has_script(const EndpointTable<Endpoint>& endpoints, const std::string& topic,
                  const messages::MessageType* other_than) const;
  void settle(const std::string& topic);
  template <class Endpoint>
  void settle(EndpointTable<Endpoint>& own_kind, const std::string& topic);

  Participant& participant_;
  Inbox& inbox_;
  EndpointTable<PublisherEndpoint> publishers_;
  EndpointTable<SubscriberEndpoint> subscribers_;
  std::set<messages::EndpointId> yielding_;
};

}  // namespace bubblesim::ros2
