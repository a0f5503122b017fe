// SPDX-License-Identifier: BSD-3-Clause
#include "topics/topics.hpp"

#include <chrono>
#include <set>
#include <utility>

namespace bubblesim::ros2 {
namespace {

constexpr std::chrono::milliseconds kMostDelivering{500};  // a subscriber may be busy, or stopped

}  // namespace

using messages::EndpointId;
using messages::MessageType;

void Topics::advertise(EndpointId id, const std::string& topic, const MessageType& type, const messages::Qos& qos) {
  endpoints_.check_type_on(topic, type);
  const auto publisher = std::make_shared<PublisherEndpoint>(topic, type, qos, outbox_);
  endpoints_.publishers.emplace(id, publisher);
  settle(topic);  // closes endpoints of another type first: DDS knows one type of a topic
  publisher->open(participant_);
}

void Topics::subscribe(EndpointId id, const std::string& topic, const MessageType& type, const messages::Qos& qos,
                       messages::MessageCallback callback) {
  endpoints_.check_type_on(topic, type);
  const auto subscriber = std::make_shared<SubscriberEndpoint>(topic, type, qos, std::move(callback), inbox_);
  endpoints_.subscribers.emplace(id, subscriber);
  settle(topic);
  subscriber->open(participant_);
}

void Topics::yield_topic(EndpointId id) { settle(endpoints_.add_yielding(id)); }

void Topics::settle(const std::string& topic) {
  endpoints_.settle(
      topic, [](const auto& endpoint) { endpoint->close(); },
      [this](const auto& endpoint) { endpoint->open(participant_); });
}

const PublisherEndpoint& Topics::publisher(EndpointId id) const {
  return *find_endpoint(endpoints_.publishers, id, "publisher")->second;
}

const SubscriberEndpoint& Topics::subscriber(EndpointId id) const {
  return *find_endpoint(endpoints_.subscribers, id, "subscriber")->second;
}

void Topics::publish(EndpointId publisher, messages::WireBuffer message) {
  PublisherEndpoint& endpoint = *find_endpoint(endpoints_.publishers, publisher, "publisher")->second;
  if (!endpoint.wants_messages()) return;
  traffic_.note_sent(message.size(), endpoint.subscribers());
  endpoint.publish(std::move(message));
}

void Topics::shutdown_publisher(EndpointId publisher) {
  const auto found = find_endpoint(endpoints_.publishers, publisher, "publisher");
  const std::shared_ptr<PublisherEndpoint> gone = std::move(found->second);
  endpoints_.publishers.erase(found);
  endpoints_.forget_yielding(publisher);
  gone->deliver(end_of_delivery());  // also what scripts publish in sysCall_cleanup
  gone->close();
  settle(gone->topic());
}

std::chrono::steady_clock::time_point Topics::end_of_delivery() {
  const auto now = std::chrono::steady_clock::now();
  if (now > first_delivery_ + std::chrono::seconds(1)) first_delivery_ = now;
  return first_delivery_ + kMostDelivering;
}

void Topics::shutdown_subscriber(EndpointId subscriber) {
  const auto found = find_endpoint(endpoints_.subscribers, subscriber, "subscriber");
  const std::shared_ptr<SubscriberEndpoint> gone = std::move(found->second);
  endpoints_.subscribers.erase(found);
  endpoints_.forget_yielding(subscriber);
  gone->silence();
  gone->close();
  settle(gone->topic());
}

void Topics::shutdown_from(EndpointId first) {
  const auto ids_of = [first](const auto& endpoints) {
    std::set<EndpointId> ids;
    for (const auto& [id, endpoint] : endpoints) {
      if (id >= first) ids.insert(id);
    }
    return ids;
  };
  for (const EndpointId id : ids_of(endpoints_.publishers)) shutdown_publisher(id);
  for (const EndpointId id : ids_of(endpoints_.subscribers)) shutdown_subscriber(id);
}

}  // namespace bubblesim::ros2
