// SPDX-License-Identifier: BSD-3-Clause
#include "topics/topics.hpp"

#include <algorithm>
#include <stdexcept>
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

void check_same_type(const std::string& topic, const MessageType& type, const char* done, const MessageType& other) {
  if (type.type_hash == other.type_hash) return;
  throw std::invalid_argument("topic '" + topic + "' is already " + done + " here as " + other.name + ", not " +
                              type.name);
}

/// A topic has one type in a node.
void Topics::check_type_on(const std::string& topic, const MessageType& type) const {
  const auto check = [&](const auto& endpoints, const char* done) {
    for (const auto& [id, other] : endpoints) {
      if (other->topic() == topic && yielding_.count(id) == 0) check_same_type(topic, type, done, other->type());
    }
  };
  check(publishers_, "advertised");
  check(subscribers_, "subscribed");
}

void Topics::advertise(EndpointId id, const std::string& topic, const MessageType& type, std::uint32_t queue_size,
                       bool latch) {
  check_type_on(topic, type);
  const auto publisher = std::make_shared<PublisherEndpoint>(topic, type, queue_size, latch);
  publishers_.emplace(id, publisher);
  settle(topic);
  put_on(publisher);
}

void Topics::subscribe(EndpointId id, const std::string& topic, const MessageType& type, std::uint32_t queue_size,
                       messages::MessageCallback callback, bool tcp_no_delay) {
  check_type_on(topic, type);
  const auto subscriber =
      std::make_shared<SubscriberEndpoint>(topic, type, queue_size, std::move(callback), tcp_no_delay, queue_, guard_);
  subscribers_.emplace(id, subscriber);
  settle(topic);
  put_on(subscriber);
}

void Topics::yield_topic(EndpointId id) {
  yielding_.try_emplace(id);
  const auto publisher = publishers_.find(id);
  settle(publisher != publishers_.end() ? publisher->second->topic()
                                        : find_endpoint(subscribers_, id, "subscriber")->second->topic());
}

template <class Endpoint>
bool Topics::has_script(const EndpointTable<Endpoint>& endpoints, const std::string& topic,
                        const MessageType* other_than) const {
  return std::any_of(endpoints.begin(), endpoints.end(), [&](const auto& entry) {
    const auto& [id, endpoint] = entry;
    if (endpoint->topic() != topic || yielding_.count(id) != 0) return false;
    return other_than == nullptr || endpoint->type().type_hash != other_than->type_hash;
  });
}

/// Deactivates the endpoints that yield, or activates them again.
void Topics::settle(const std::string& topic) {
  settle(publishers_, topic);
  settle(subscribers_, topic);
}

template <class Endpoint>
void Topics::settle(EndpointTable<Endpoint>& own_kind, const std::string& topic) {
  for (auto& [id, was_off] : yielding_) {
    const auto found = own_kind.find(id);
    if (found == own_kind.end() || found->second->topic() != topic) continue;
    const MessageType& type = found->second->type();
    const bool off = has_script(publishers_, topic, &type) || has_script(subscribers_, topic, &type);
    found->second->set_aside(off || has_script(own_kind, topic, nullptr));
    // With an equal type the endpoint stays registered, and keeps its connections to other nodes.
    if (off == std::exchange(was_off, off)) continue;
    if (off) {
      take_off(found->second);
    } else {
      found->second = renewed(found->second);
      put_on(found->second);
    }
  }
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
  return find_endpoint(publishers_, publisher, "publisher")->second->wants_messages();
}

bool Topics::has_publisher(EndpointId subscriber) const {
  return find_endpoint(subscribers_, subscriber, "subscriber")->second->has_publisher();
}

WaitingCount Topics::waiting(EndpointId subscriber) const {
  return find_endpoint(subscribers_, subscriber, "subscriber")->second->waiting();
}

void Topics::look_for_publishers() {
  for (const auto& subscriber : registered_) subscriber->look_for_publisher();
}

const MessageType& Topics::type(EndpointId id) const {
  const auto publisher = publishers_.find(id);
  if (publisher != publishers_.end()) return publisher->second->type();
  return find_endpoint(subscribers_, id, "publisher or subscriber")->second->type();
}

void Topics::publish(EndpointId publisher, messages::WireBuffer message) {
  find_endpoint(publishers_, publisher, "publisher")->second->publish(std::move(message));
}

bool Topics::forget_yielding(EndpointId id) {
  const auto node = yielding_.extract(id);
  return node && node.mapped();
}

void Topics::shutdown_publisher(EndpointId publisher) {
  const auto found = find_endpoint(publishers_, publisher, "publisher");
  const std::shared_ptr<PublisherEndpoint> gone = std::move(found->second);
  publishers_.erase(found);
  if (!forget_yielding(publisher)) take_off(gone);
  settle(gone->topic());
}

void Topics::shutdown_subscriber(EndpointId subscriber) {
  const auto found = find_endpoint(subscribers_, subscriber, "subscriber");
  const std::shared_ptr<SubscriberEndpoint> gone = std::move(found->second);
  subscribers_.erase(found);
  gone->silence();
  if (!forget_yielding(subscriber)) take_off(gone);
  settle(gone->topic());
}

std::size_t Topics::publishers_on(const std::string& topic) const {
  return static_cast<std::size_t>(std::count_if(publishers_.begin(), publishers_.end(),
                                                [&](const auto& entry) { return entry.second->topic() == topic; }));
}

void Topics::shutdown_all() {
  while (!publishers_.empty()) shutdown_publisher(publishers_.begin()->first);
  while (!subscribers_.empty()) shutdown_subscriber(subscribers_.begin()->first);
}

void Topics::silence() {
  for (const auto& [id, subscriber] : subscribers_) subscriber->silence();
}

}  // namespace bubblesim
