// SPDX-License-Identifier: BSD-3-Clause
#include "topics/topics.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace bubblesim::ros2 {

using messages::EndpointId;
using messages::MessageType;

/// A topic has one type in a node.
void Topics::check_type_on(const std::string& topic, const MessageType& type) const {
  const auto check = [&](const auto& endpoints, const char* done) {
    for (const auto& [id, other] : endpoints) {
      if (other->topic() != topic || yielding_.count(id) != 0 || other->type().type_hash == type.type_hash) continue;
      throw std::invalid_argument("topic '" + topic + "' is already " + done + " here as " + other->type().name +
                                  ", not " + type.name);
    }
  };
  check(publishers_, "advertised");
  check(subscribers_, "subscribed");
}

void Topics::advertise(EndpointId id, const std::string& topic, const MessageType& type, const messages::Qos& qos) {
  check_type_on(topic, type);
  const auto publisher = std::make_shared<PublisherEndpoint>(topic, type, qos);
  publishers_.emplace(id, publisher);
  settle(topic);  // closes endpoints of another type first: DDS knows one type of a topic
  publisher->open(participant_);
}

void Topics::subscribe(EndpointId id, const std::string& topic, const MessageType& type, const messages::Qos& qos,
                       messages::MessageCallback callback) {
  check_type_on(topic, type);
  const auto subscriber = std::make_shared<SubscriberEndpoint>(topic, type, qos, std::move(callback), inbox_);
  subscribers_.emplace(id, subscriber);
  settle(topic);
  subscriber->open(participant_);
}

void Topics::yield_topic(EndpointId id) {
  yielding_.insert(id);
  const auto publisher = publishers_.find(id);
  settle(publisher != publishers_.end() ? publisher->second->topic() : subscriber(id).topic());
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

/// Closes the endpoints that yield, or opens them again.
void Topics::settle(const std::string& topic) {
  settle(publishers_, topic);
  settle(subscribers_, topic);
}

template <class Endpoint>
void Topics::settle(EndpointTable<Endpoint>& own_kind, const std::string& topic) {
  for (const EndpointId id : yielding_) {
    const auto found = own_kind.find(id);
    if (found == own_kind.end() || found->second->topic() != topic) continue;
    Endpoint& endpoint = *found->second;
    const bool off =
        has_script(publishers_, topic, &endpoint.type()) || has_script(subscribers_, topic, &endpoint.type());
    endpoint.set_aside(off || has_script(own_kind, topic, nullptr));
    if (off == !endpoint.is_open()) continue;
    if (off) {
      endpoint.close();
    } else {
      endpoint.open(participant_);
    }
  }
}

const PublisherEndpoint& Topics::publisher(EndpointId id) const {
  return *find_endpoint(publishers_, id, "publisher")->second;
}

const SubscriberEndpoint& Topics::subscriber(EndpointId id) const {
  return *find_endpoint(subscribers_, id, "subscriber")->second;
}

const MessageType& Topics::type(EndpointId id) const {
  const auto publisher = publishers_.find(id);
  if (publisher != publishers_.end()) return publisher->second->type();
  return find_endpoint(subscribers_, id, "publisher or subscriber")->second->type();
}

void Topics::publish(EndpointId publisher, messages::WireBuffer message) {
  find_endpoint(publishers_, publisher, "publisher")->second->publish(std::move(message));
}

void Topics::shutdown_publisher(EndpointId publisher) {
  const auto found = find_endpoint(publishers_, publisher, "publisher");
  const std::shared_ptr<PublisherEndpoint> gone = std::move(found->second);
  publishers_.erase(found);
  yielding_.erase(publisher);
  gone->close();
  settle(gone->topic());
}

void Topics::shutdown_subscriber(EndpointId subscriber) {
  const auto found = find_endpoint(subscribers_, subscriber, "subscriber");
  const std::shared_ptr<SubscriberEndpoint> gone = std::move(found->second);
  subscribers_.erase(found);
  yielding_.erase(subscriber);
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
  for (const EndpointId id : ids_of(publishers_)) shutdown_publisher(id);
  for (const EndpointId id : ids_of(subscribers_)) shutdown_subscriber(id);
}

std::size_t Topics::publishers_on(const std::string& topic) const {
  return static_cast<std::size_t>(std::count_if(publishers_.begin(), publishers_.end(),
                                                [&](const auto& entry) { return entry.second->topic() == topic; }));
}

}  // namespace bubblesim::ros2
