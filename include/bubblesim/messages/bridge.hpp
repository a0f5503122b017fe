// SPDX-License-Identifier: BSD-3-Clause
// What child scripts ask of a message bridge. Scripts translate their values to wire bytes; a bridge only moves bytes,
// so it needs to know nothing of scripts, and scripts nothing of ROS. src/ros_bridge implements it.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>

#include "bubblesim/messages/message_type.hpp"
#include "bubblesim/messages/wire.hpp"

namespace bubblesim::messages {

/// Names a publisher, subscriber, service server or client. Never used again after shutdown, so a stale one is noticed.
using EndpointId = std::int32_t;

/// Called on the simulation's thread while Bridge::process_input() runs; the bytes are valid during the call.
using MessageCallback = std::function<void(WireView message)>;

/// Takes the bytes of a request (valid during the call) and returns those of the response. Called on the simulation's
/// thread, while Bridge::process_input(), call() or wait_for_service() runs. When it throws, the caller gets the text.
using ServiceCallback = std::function<WireBuffer(WireView request)>;

/// A service call that brought no response, and why; thrown by a ServiceCallback, that the request cannot be met.
struct ServiceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// That there is no master to ask, or that it does not answer.
struct NoMaster : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// std::monostate stands for lists and dictionaries, which scripts do not read.
using ParameterValue = std::variant<std::monostate, bool, std::int32_t, double, std::string>;

struct BridgeTime {
  std::uint32_t sec = 0;
  std::uint32_t nanosec = 0;
};

/// All calls come from the simulation's thread and, but for those that say so, return at once: a bridge
/// talks to its master on a thread of its own, so an endpoint made while no master is reachable comes alive when one
/// appears. Errors (unusable name, unknown or shut-down id) are std::invalid_argument with a text for the script's
/// author.
class Bridge {
 public:
  virtual ~Bridge() = default;

  /// `topic` follows ROS names: absolute `/a`, relative `a` (below the node's own name), `~a`. `type` must live as long
  /// as the bridge. At most `queue_size` messages wait to be sent or delivered, the oldest go first; 0 sets no limit.
  virtual EndpointId advertise(const std::string& topic, const MessageType& type, std::uint32_t queue_size,
                               bool latch) = 0;
  /// `tcp_no_delay`: publishers shall send each message at once rather than wait for a fuller packet; where a node has
  /// several subscribers of a topic, the first one's wish holds.
  virtual EndpointId subscribe(const std::string& topic, const MessageType& type, std::uint32_t queue_size,
                               MessageCallback callback, bool tcp_no_delay) = 0;
  /// For endpoints of the simulator itself: from now on this publisher (subscriber) publishes (delivers) nothing while
  /// there is another on its topic, nor while its topic is used under another type, which it does not keep from being.
  virtual void yield_topic(EndpointId publisher_or_subscriber) = 0;
  /// For endpoints of the simulator itself: has urgent_waits() look at this subscriber or service server.
  virtual void set_priority(EndpointId subscriber_or_server) = 0;
  /// Whether a message or request has come to such an endpoint and not been delivered yet. From any thread.
  virtual bool urgent_waits() const = 0;
  /// Whether publish() would have any effect now: somebody listens, or the publisher latches.
  virtual bool wants_messages(EndpointId publisher) const = 0;
  /// Whether anybody publishes to a subscriber, as it was a quarter of a second ago.
  virtual bool has_publisher(EndpointId subscriber) const = 0;
  virtual const MessageType& message_type(EndpointId endpoint) const = 0;
  virtual void publish(EndpointId publisher, WireBuffer message) = 0;
  virtual void shutdown_publisher(EndpointId publisher) = 0;
  virtual void shutdown_subscriber(EndpointId subscriber) = 0;

  /// Offers a service. `name` is resolved as topics are; `type` must live as long as the bridge.
  virtual EndpointId advertise_service(const std::string& name, const ServiceType& type, ServiceCallback callback) = 0;
  virtual EndpointId service_client(const std::string& name, const ServiceType& type) = 0;
  virtual const ServiceType& service_type(EndpointId server_or_client) const = 0;
  /// The service's response to `request`. Waits for it `timeout` seconds at most, and meanwhile answers requests to
  /// services that this bridge offers (but delivers no messages), so a service may be called by the node that offers
  /// it. Throws ServiceError: no such service, of another type, its own error text, connection lost, no answer in time;
  /// std::invalid_argument for a timeout that is not a positive number.
  virtual WireBuffer call(EndpointId client, WireBuffer request, double timeout) = 0;
  /// Whether somebody offers the service; waits `timeout` seconds at most (0: looks once), as call() does.
  virtual bool wait_for_service(const std::string& name, double timeout) = 0;
  virtual void shutdown_service_server(EndpointId server) = 0;
  virtual void shutdown_service_client(EndpointId client) = 0;

  /// The master's parameters, of which nothing is set without a master; names are resolved as those of topics. Reading
  /// waits for the answer, and throws NoMaster when none has come from the master for a second. Writing does not wait;
  /// what is read afterwards is what was written.
  virtual std::optional<ParameterValue> get_parameter(const std::string& name) = 0;
  virtual void set_parameter(const std::string& name, const ParameterValue& value) = 0;
  virtual void delete_parameter(const std::string& name) = 0;
  /// Full name of the parameter in the nearest namespace that has it, from the node's own upwards.
  virtual std::optional<std::string> search_parameter(const std::string& name) = 0;

  /// Delivers what has arrived since the last call to the callbacks: messages, then service requests. A callback may
  /// call the bridge, shut its own endpoint down included; what it throws (but ServiceError) is passed on after the
  /// others have been served. A call from within a message's callback does nothing; a service's callback may call it,
  /// as one does that lets the simulation run on while it works.
  virtual void process_input() = 0;

  /// Time that messages should be stamped with: the simulation's when /use_sim_time is set, else the wall clock's.
  virtual BridgeTime now() const = 0;
  /// Whether another node hears what this one publishes on /clock; true when nodes take the wall clock's time.
  virtual bool clock_reaches_others() const = 0;
};

}  // namespace bubblesim::messages
