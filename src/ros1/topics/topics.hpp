// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/callback_queue_interface.h>

#include <memory>
#include <set>
#include <string>
#include <unordered_map>

#include "bubblesim/messages/bridge.hpp"
#include "peers/publisher_check.hpp"
#include "topics/callback_guard.hpp"
#include "topics/endpoint_table.hpp"
#include "topics/endpoints.hpp"

namespace bubblesim {

class MasterThread;

/// The publishers and subscribers of a node; messages::Bridge tells what the functions do. All belongs to the
/// simulation's thread, unless said otherwise.
class Topics {
 public:
  /// Messages come through `queue`. All must outlive what is posted to `master`.
  Topics(MasterThread& master, PublisherCheck& check, ros::CallbackQueueInterface& queue, CallbackGuard& guard)
      : master_(master), publisher_check_(check), queue_(queue), guard_(guard) {}

  /// `topic` is a full name. Throws std::invalid_argument when it has another type in this node.
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

  /// How many publishers there are on a topic.
  std::size_t publishers_on(const std::string& topic) const;
  /// For the master thread: brings has_publisher() up to date.
  void look_for_publishers();
  /// Silences all subscribers, for the end of the bridge.
  void silence();

 private:
  /// Of an endpoint that gives way, what it does.
  struct Standing {
    bool aside = false;  ///< neither sends nor delivers
    bool off = false;    ///< is not registered either, for the topic has another type meanwhile
  };

  bool is_aside(messages::EndpointId id) const;
  Standing forget_standing(messages::EndpointId id);
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
  std::unordered_map<messages::EndpointId, Standing> giving_way_;
  std::set<std::shared_ptr<SubscriberEndpoint>> registered_;  // the master thread's
};

/// Throws std::invalid_argument: what is `done` on the topic already is of another type.
void check_same_type(const std::string& topic, const messages::MessageType& type, const char* done,
                     const messages::MessageType& other);

}  // namespace bubblesim
