// SPDX-License-Identifier: BSD-3-Clause
// The message bridge interface of child scripts. Scripts convert their values to wire bytes and a bridge only transfers
// bytes, so the bridge does not depend on scripts, nor scripts on ROS. src/ros1 and src/ros2 implement it.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>

#include "bubblesim/messages/message_type.hpp"
#include "bubblesim/messages/qos.hpp"
#include "bubblesim/messages/wire.hpp"

namespace bubblesim::messages {

/// Handle of a publisher, subscriber, service server or client. Never reused after shutdown, so a stale handle is
/// detected.
using EndpointId = std::int32_t;

/// Called on the simulation's thread during Bridge::process_input(); the bytes are valid during the call.
using MessageCallback = std::function<void(WireView message)>;

/// Receives the bytes of a request (valid during the call) and returns those of the response. Called on the
/// simulation's thread during Bridge::process_input(), call() or wait_for_service(). The text of an exception is
/// returned to the caller of the service.
using ServiceCallback = std::function<WireBuffer(WireView request)>;

/// A service call failed, with the reason. A ServiceCallback throws it to reject a request.
struct ServiceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The server that keeps the parameters does not answer: the master of ROS 1. In ROS 2, a node keeps its own.
struct NoParameterServer : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// std::monostate stands for lists and dictionaries, which scripts do not read.
using ParameterValue = std::variant<std::monostate, bool, std::int32_t, double, std::string>;

class LaterServices;

struct BridgeTime {
  std::uint32_t sec = 0;
  std::uint32_t nanosec = 0;
};

/// All calls come from the simulation's thread and, unless stated otherwise, return at once: a bridge communicates with
/// its peers on threads of its own. An endpoint created without peers becomes active when they appear. Errors (invalid
/// name, unknown or shut-down id) are std::invalid_argument, with a string for the author of the script.
class Bridge {
 public:
  virtual ~Bridge() = default;

  /// The version of the types that it takes.
  virtual RosVersion version() const = 0;

  /// `topic` is a ROS name: absolute `/a`, relative `a` (ROS 1: below the node's own name, ROS 2: in the node's
  /// namespace), `~a`. `type` must live as long as the bridge.
  virtual EndpointId advertise(const std::string& topic, const MessageType& type, const Qos& qos) = 0;
  virtual EndpointId subscribe(const std::string& topic, const MessageType& type, const Qos& qos,
                               MessageCallback callback) = 0;
  /// For endpoints of the simulator itself: from now on this publisher (subscriber) publishes (delivers) nothing while
  /// its topic has another one, or while its topic is used with another type, which remains possible.
  virtual void yield_topic(EndpointId publisher_or_subscriber) = 0;
  /// For endpoints of the simulator itself: makes urgent_waits() check this subscriber or service server.
  virtual void set_priority(EndpointId subscriber_or_server) = 0;
  /// Whether a message or request for such an endpoint has arrived and is not delivered yet. Thread-safe.
  virtual bool urgent_waits() const = 0;
  /// Whether publish() would have an effect now: there is a subscriber, or the publisher keeps messages for late ones.
  virtual bool wants_messages(EndpointId publisher) const = 0;
  /// Whether a subscriber has a publisher; up to a quarter of a second old.
  virtual bool has_publisher(EndpointId subscriber) const = 0;
  virtual const MessageType& message_type(EndpointId endpoint) const = 0;
  virtual void publish(EndpointId publisher, WireBuffer message) = 0;
  virtual void shutdown_publisher(EndpointId publisher) = 0;
  virtual void shutdown_subscriber(EndpointId subscriber) = 0;

  /// Advertises a service. `name` is resolved like a topic; `type` must live as long as the bridge.
  virtual EndpointId advertise_service(const std::string& name, const ServiceType& type, ServiceCallback callback) = 0;
  virtual EndpointId service_client(const std::string& name, const ServiceType& type) = 0;
  virtual const ServiceType& service_type(EndpointId server_or_client) const = 0;
  /// Returns the service's response to `request`. Waits at most `timeout` seconds and meanwhile serves requests to the
  /// services of this bridge (but delivers no messages), so a node may call its own services. Throws ServiceError: no
  /// such service, wrong type, error text of the service, connection lost, timeout; std::invalid_argument for a timeout
  /// that is not a positive number.
  virtual WireBuffer call(EndpointId client, WireBuffer request, double timeout) = 0;
  /// Whether the service is advertised; waits at most `timeout` seconds (0: checks once), like call().
  virtual bool wait_for_service(const std::string& name, double timeout) = 0;
  virtual void shutdown_service_server(EndpointId server) = 0;
  virtual void shutdown_service_client(EndpointId client) = 0;
  /// Null for a bridge without them.
  virtual LaterServices* later_services() { return nullptr; }

  /// Parameters: in ROS 1 those of all nodes, which the master keeps; in ROS 2 those of this node, `~a` or `a`. Reading
  /// waits for the answer, and throws NoParameterServer when the master has not answered for a second. Writing does not
  /// wait; a later read returns the written value.
  virtual std::optional<ParameterValue> get_parameter(const std::string& name) = 0;
  virtual void set_parameter(const std::string& name, const ParameterValue& value) = 0;
  virtual void delete_parameter(const std::string& name) = 0;
  /// Full name of the parameter in the nearest namespace that has it, from the node's own namespace upwards.
  virtual std::optional<std::string> search_parameter(const std::string& name) = 0;

  /// Delivers everything that arrived since the last call to the callbacks: messages, then service requests. A callback
  /// may call the bridge, and may shut its own endpoint down. Its exceptions (except ServiceError) are rethrown after
  /// the other callbacks ran. A call from within a message callback does nothing; a service callback may call it, for
  /// example to run the simulation while it works.
  virtual void process_input() = 0;

  /// Time for time stamps of messages: when use_sim_time is set, the time of the simulation's state, else wall clock
  /// time.
  virtual BridgeTime now() const = 0;
  /// Whether another node receives this node's /clock; true when nodes use the wall clock.
  virtual bool clock_reaches_others() const = 0;
};

}  // namespace bubblesim::messages
