// SPDX-License-Identifier: BSD-3-Clause
// The publishers and subscribers of a node by topic: one type for a topic, and who stands aside for whom.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>

#include "bubblesim/messages/bridge.hpp"
#include "endpoint_table.hpp"

namespace bubblesim {

/// Throws std::invalid_argument if the topic is already `done` with another type.
inline void check_same_type(const std::string& topic, const messages::MessageType& type, const char* done,
                            const messages::MessageType& other) {
  if (type.type_hash == other.type_hash) return;
  throw std::invalid_argument("topic '" + topic + "' is already " + done + " here as " + other.name + ", not " +
                              type.name);
}

/// `Publisher` and `Subscriber` have topic(), type() and set_aside().
template <class Publisher, class Subscriber>
class TopicEndpoints {
 public:
  EndpointTable<Publisher> publishers;
  EndpointTable<Subscriber> subscribers;

  /// A topic has one type in a node. Throws std::invalid_argument.
  void check_type_on(const std::string& topic, const messages::MessageType& type) const {
    const auto check = [&](const auto& endpoints, const char* done) {
      for (const auto& [id, other] : endpoints) {
        if (other->topic() == topic && yielding_.count(id) == 0) check_same_type(topic, type, done, other->type());
      }
    };
    check(publishers, "advertised");
    check(subscribers, "subscribed");
  }

  const messages::MessageType& type(messages::EndpointId id) const {
    const auto publisher = publishers.find(id);
    if (publisher != publishers.end()) return publisher->second->type();
    return find_endpoint(subscribers, id, "publisher or subscriber")->second->type();
  }

  /// From here on the endpoint yields to others. Returns its topic, which has to be settled.
  const std::string& add_yielding(messages::EndpointId id) {
    yielding_.try_emplace(id);
    const auto publisher = publishers.find(id);
    if (publisher != publishers.end()) return publisher->second->topic();
    return find_endpoint(subscribers, id, "subscriber")->second->topic();
  }

  /// Returns whether it was off.
  bool forget_yielding(messages::EndpointId id) {
    const auto node = yielding_.extract(id);
    return node && node.mapped();
  }

  /// Sets aside the endpoints that yield on a topic, or no longer. Calls `turn_off` or `turn_on` with the shared_ptr of
  /// those that are off because the topic now has another type, or no longer: with an equal type an endpoint keeps its
  /// connections to other nodes.
  template <class TurnOff, class TurnOn>
  void settle(const std::string& topic, TurnOff turn_off, TurnOn turn_on) {
    settle(publishers, topic, turn_off, turn_on);
    settle(subscribers, topic, turn_off, turn_on);
  }

 private:
  template <class Endpoint, class TurnOff, class TurnOn>
  void settle(EndpointTable<Endpoint>& own_kind, const std::string& topic, TurnOff& turn_off, TurnOn& turn_on) {
    for (auto& [id, was_off] : yielding_) {
      const auto found = own_kind.find(id);
      if (found == own_kind.end() || found->second->topic() != topic) continue;
      const messages::MessageType& type = found->second->type();
      const bool off = has_script(publishers, topic, &type) || has_script(subscribers, topic, &type);
      found->second->set_aside(off || has_script(own_kind, topic, nullptr));
      if (off == std::exchange(was_off, off)) continue;
      if (off) {
        turn_off(found->second);
      } else {
        turn_on(found->second);
      }
    }
  }

  template <class Endpoint>
  bool has_script(const EndpointTable<Endpoint>& endpoints, const std::string& topic,
                  const messages::MessageType* other_than) const {
    return std::any_of(endpoints.begin(), endpoints.end(), [&](const auto& entry) {
      const auto& [id, endpoint] = entry;
      if (endpoint->topic() != topic || yielding_.count(id) != 0) return false;
      return other_than == nullptr || endpoint->type().type_hash != other_than->type_hash;
    });
  }

  /// The endpoints that yield, and whether each is off: its topic currently has another type.
  std::unordered_map<messages::EndpointId, bool> yielding_;
};

}  // namespace bubblesim
