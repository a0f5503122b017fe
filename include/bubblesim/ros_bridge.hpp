// SPDX-License-Identifier: BSD-3-Clause
// The simulator as a ROS 1 node: transfers the messages of child scripts, publishes /clock, provides ROS time.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "bubblesim/node_bridge.hpp"

namespace bubblesim {

struct RosBridgeOptions : NodeBridgeOptions {
  /// What else the user can do without a master, besides to start one: it is added to that line of the log.
  std::string without_master;
  /// If another node on the master has the same name, take over the name, which ends that node. If false, such a name
  /// is an error.
  bool replace = false;
  /// Called on a thread of roscpp when the node is asked to shut down: by `rosnode kill`, or by the master when another
  /// node takes the name. The string states by whom and why. If empty, roscpp shuts down and the process goes on.
  std::function<void(const std::string& why)> on_shutdown;
};

/// At most one per process, because roscpp is global. All calls come from the simulation's thread. Calls that may wait
/// for the master run on a thread of the bridge, so ROS never blocks the simulation. When the master restarts or drops
/// the node, everything is registered again within half a second of the master's first answer (within a second if it
/// only dropped the node); messages to and from connected nodes keep flowing.
class RosBridge final : public NodeBridge {
 public:
  /// Removes the remappings (`a:=b`, `__name:=`, `__ns:=`, `__master:=`) from the command line. If a master answers
  /// within a second, returns connected. Otherwise prints a line on stderr with the URI and the remedy, and connects as
  /// soon as a master appears. The default of ROS_MASTER_URI is http://localhost:11311. Throws std::invalid_argument
  /// for an invalid master URI or node name, for a name that another node on that master has, and, with on_step, for
  /// another simulator that publishes /clock there; std::logic_error for a second bridge. If a master appears later and
  /// such a node is on it, the bridge reports this once and connects when that node has ended.
  RosBridge(int& argc, char** argv, RosBridgeOptions options = {});

  /// Unregisters everything from the master. Returns within 2 s even if the master is gone or does not respond.
  ~RosBridge() override;

  /// Unregisters everything from the master.
  bool leave() override;

  RosBridge(const RosBridge&) = delete;
  RosBridge& operator=(const RosBridge&) = delete;

  messages::RosVersion version() const override { return messages::RosVersion::kRos1; }
  messages::EndpointId advertise(const std::string& topic, const messages::MessageType& type,
                                 const messages::Qos& qos) override;
  messages::EndpointId subscribe(const std::string& topic, const messages::MessageType& type, const messages::Qos& qos,
                                 messages::MessageCallback callback) override;
  void set_priority(messages::EndpointId subscriber_or_server) override;
  bool urgent_waits() const override;
  void yield_topic(messages::EndpointId endpoint) override;
  bool wants_messages(messages::EndpointId publisher) const override;
  bool has_publisher(messages::EndpointId subscriber) const override;
  const messages::MessageType& message_type(messages::EndpointId endpoint) const override;
  void publish(messages::EndpointId publisher, messages::WireBuffer message) override;
  void shutdown_publisher(messages::EndpointId publisher) override;
  void shutdown_subscriber(messages::EndpointId subscriber) override;
  messages::EndpointId advertise_service(const std::string& name, const messages::ServiceType& type,
                                         messages::ServiceCallback callback) override;
  messages::EndpointId service_client(const std::string& name, const messages::ServiceType& type) override;
  const messages::ServiceType& service_type(messages::EndpointId server_or_client) const override;
  messages::WireBuffer call(messages::EndpointId client, messages::WireBuffer request, double timeout) override;
  bool wait_for_service(const std::string& name, double timeout) override;
  void shutdown_service_server(messages::EndpointId server) override;
  void shutdown_service_client(messages::EndpointId client) override;
  std::optional<messages::ParameterValue> get_parameter(const std::string& name) override;
  void set_parameter(const std::string& name, const messages::ParameterValue& value) override;
  void delete_parameter(const std::string& name) override;
  std::optional<std::string> search_parameter(const std::string& name) override;
  void process_input() override;
  messages::BridgeTime now() const override;
  bool clock_reaches_others() const override;

  void publish_clock(double sim_time) override;
  void shutdown_endpoints() override;
  void publish_diagnostics() override;
  NodeGraph graph() override;
  std::string node_name() const override;

  /// Whether the node is registered at a master that responded to the last check (four checks a second).
  bool connected() const;
  std::string master_uri() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace bubblesim
