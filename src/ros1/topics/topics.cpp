// SPDX-License-Identifier: BSD-3-Clause
#include "topics/topics.hpp"

#include <algorithm>
#include <utility>

#include "master/master_thread.hpp"

namespace bubblesim {

using messages::EndpointId;
using messages::MessageType;

namespace {

/// Returns the endpoint to register again. A publisher is replaced, because the simulation thread may read its
/// registration while the master thread makes the next.
std::shared_ptr<PublisherEndpoint> renewed(const std::shared_ptr<PublisherEndpoint>& publisher) {
  return publisher->unregistered_copy();
}
std::shared_ptr<SubscriberEndpoint> renewed(const std::shared_ptr<SubscriberEndpoint>& subscriber) {
  return subscriber;
}

}  // namespace

void Topics::advertise(EndpointId id, const std::string& topic, const MessageType& type, std::uint32_t queue_size,
                       bool latch) {
  endpoints_.check_type_on(topic, type);
  const auto publisher = std::make_shared<PublisherEndpoint>(topic, type, queue_size, latch);
  endpoints_.publishers.emplace(id, publisher);
  settle(topic);
  put_on(publisher);
}

void Topics::subscribe(EndpointId id, const std::string& topic, const MessageType& type, const messages::Qos& qos,
                       messages::MessageCallback callback) {
  endpoints_.check_type_on(topic, type);
  const auto subscriber = std::make_shared<SubscriberEndpoint>(topic, type, qos, std::move(callback), queue_, guard_);
  endpoints_.subscribers.emplace(id, subscriber);
  settle(topic);
  put_on(subscriber);
}

void Topics::yield_topic(EndpointId id) { settle(endpoints_.add_yielding(id)); }

void Topics::settle(const std::string& topic) {
  endpoints_.settle(
      topic, [this](const auto& endpoint) { take_off(endpoint); },
      [this](auto& endpoint) {
        endpoint = renewed(endpoint);
        put_on(endpoint);
      });
}

void Topics::put_on(std::shared_ptr<PublisherEndpoint> publisher) {
  master_.post([publisher = std::move(publisher)] { publisher->register_at_master(); });
}

void Topics::put_on(std::shared_ptr<SubscriberEndpoint> subscriber) {
  master_.post([this, subscriber = std::move(subscriber)] {
    subscriber->register_at_master();
    registered_.insert(subscriber);
    publisher_check_.add(subscriber->topic(), subscriber->type());
  });
}

void Topics::take_off(std::shared_ptr<PublisherEndpoint> publisher) {
  master_.post([publisher = std::move(publisher)] { publisher->unregister_from_master(); });
}

void Topics::take_off(std::shared_ptr<SubscriberEndpoint> subscriber) {
  master_.post([this, subscriber = std::move(subscriber)] {
    publisher_check_.remove(subscriber->topic());
    registered_.erase(subscriber);
    subscriber->unregister_from_master();
  });
}

bool Topics::wants_messages(EndpointId publisher) const {
  return find_endpoint(endpoints_.publishers, publisher, "publisher")->second->wants_messages();
}

bool Topics::has_publisher(EndpointId subscriber) const {
  return find_endpoint(endpoints_.subscribers, subscriber, "subscriber")->second->has_publisher();
}

WaitingCount Topics::waiting(EndpointId subscriber) const {
  return find_endpoint(endpoints_.subscribers, subscriber, "subscriber")->second->waiting();
}

void Topics::look_for_publishers() {
  for (const auto& subscriber : registered_) subscriber->look_for_publisher();
}

void Topics::publish(EndpointId publisher, messages::WireBuffer message) {
  find_endpoint(endpoints_.publishers, publisher, "publisher")->second->publish(std::move(message));
}

void Topics::shutdown_publisher(EndpointId publisher) {
  const auto found = find_endpoint(endpoints_.publishers, publisher, "publisher");
  const std::shared_ptr<PublisherEndpoint> gone = std::move(found->second);
  endpoints_.publishers.erase(found);
  if (!endpoints_.forget_yielding(publisher)) take_off(gone);
  settle(gone->topic());
}

void Topics::shutdown_subscriber(EndpointId subscriber) {
  const auto found = find_endpoint(endpoints_.subscribers, subscriber, "subscriber");
  const std::shared_ptr<SubscriberEndpoint> gone = std::move(found->second);
  endpoints_.subscribers.erase(found);
  gone->silence();
  if (!endpoints_.forget_yielding(subscriber)) take_off(gone);
  settle(gone->topic());
}

std::size_t Topics::publishers_on(const std::string& topic) const {
  return static_cast<std::size_t>(std::count_if(endpoints_.publishers.begin(), endpoints_.publishers.end(),
                                                [&](const auto& entry) { return entry.second->topic() == topic; }));
}

void Topics::shutdown_all() {
  while (!endpoints_.publishers.empty()) shutdown_publisher(endpoints_.publishers.begin()->first);
  while (!endpoints_.subscribers.empty()) shutdown_subscriber(endpoints_.subscribers.begin()->first);
}

void Topics::silence() {
  for (const auto& [id, subscriber] : endpoints_.subscribers) subscriber->silence();
}

}  // namespace bubblesim
