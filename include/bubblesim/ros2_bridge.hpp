// SPDX-License-Identifier: BSD-3-Clause
// The simulator as a ROS 2 node, by Fast DDS: transfers the messages of child scripts and plugins, publishes /clock.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "bubblesim/messages/later_services.hpp"
#include "bubblesim/node_bridge.hpp"

namespace bubblesim {

/// There is no master: nodes find each other in the domain ROS_DOMAIN_ID, here on this machine. Messages arrive on
/// threads of Fast DDS and wait for process_input(). All calls come from the simulation's thread.
class Ros2Bridge final : public NodeBridge, public messages::LaterServices {
 public:
  /// Takes the arguments for a ROS node (`a:=b`, `__name:=`, `__ns:=`, `_parameter:=`) off the command line. The usual
  /// name of the node is sim_ros2_interface. Throws std::invalid_argument for an invalid name or environment, and
  /// std::runtime_error without a network.
  Ros2Bridge(int& argc, char** argv, NodeBridgeOptions options = {});
  ~Ros2Bridge() override;
  Ros2Bridge(const Ros2Bridge&) = delete;
  Ros2Bridge& operator=(const Ros2Bridge&) = delete;

  messages::RosVersion version() const override { return messages::RosVersion::kRos2; }
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
  messages::LaterServices* later_services() override { return this; }
  messages::EndpointId advertise_service_later(const std::string& name, const messages::ServiceType& type,
                                               messages::RequestCallback on_request) override;
  void reply(messages::EndpointId server, messages::RequestNumber request, messages::WireBuffer response) override;
  bool service_is_ready(messages::EndpointId client) const override;
  void call_later(messages::EndpointId client, messages::WireBuffer request,
                  messages::MessageCallback on_response) override;
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
  /// Peers notice by themselves, within the lease of 20 s, when a process is gone.
  bool leave() override { return true; }
  NodeGraph graph() override;
  std::string node_name() const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace bubblesim
