// SPDX-License-Identifier: BSD-3-Clause
// The simulator as a ROS 1 node: moves the message bytes of child scripts, publishes /clock, tells ROS time.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "bubblesim/messages/bridge.hpp"
#include "bubblesim/run_report.hpp"

namespace bubblesim {

struct RosBridgeOptions {
  /// Name of the node unless the command line says `__name:=other`.
  std::string node_name = "sim_ros_interface";
  /// Called from process_input() with true when the service ~pause is called, with false for ~unpause (both
  /// std_srvs/Empty). Without it the services are not offered.
  std::function<void(bool paused)> on_pause;
  /// Takes the name from a node that has it on the master, which ends that node; otherwise such a name is refused.
  bool replace = false;
  /// Called on a thread of roscpp when somebody wants the node to end: `rosnode kill`, or the master when another node
  /// takes its name. The text says who and why. Without it roscpp stops and the process goes on.
  std::function<void(const std::string& why)> on_shutdown;
  /// Asked while a service call waits; when it says true (the process was told to end), the call is given up.
  std::function<bool()> is_ending;
  /// Called on another thread once a second, for what is published on /diagnostics; without it nothing is.
  std::function<RunReport()> take_report;
};

/// One per process, for roscpp is global. All calls come from the simulation's thread; what may wait for the master
/// runs on a thread of the bridge's own, so the simulation never stands still for ROS. When the master is replaced by
/// another, or forgets the node, everything is registered again within half a second of its first answer (a second,
/// when it only forgot); messages to and from connected nodes flow all the time.
class RosBridge final : public messages::Bridge {
 public:
  /// Takes the remappings (`a:=b`, `__name:=`, `__ns:=`, `__master:=`) out of the command line. When a
  /// master answers within a second it returns connected; else after a line on stderr that names the URI tried and the
  /// cure, and connects as soon as a master appears. Without ROS_MASTER_URI, http://localhost:11311 is used.
  /// Throws std::invalid_argument for an unusable master URI or node name, and for a name that another node has on that
  /// master; std::logic_error for a second bridge. When a master appears later on which another node has the name, the
  /// bridge says so once and connects when that node has ended.
  RosBridge(int& argc, char** argv, RosBridgeOptions options = {});

  /// Takes everything off the master; ends within 2 s even if the master is gone or hangs.
  ~RosBridge() override;

  /// Takes everything off the master, as the destructor does; any thread may call it, before the process is ended by
  /// force.
  bool leave();

  RosBridge(const RosBridge&) = delete;
  RosBridge& operator=(const RosBridge&) = delete;

  messages::EndpointId advertise(const std::string& topic, const messages::MessageType& type, std::uint32_t queue_size,
                                 bool latch) override;
  messages::EndpointId subscribe(const std::string& topic, const messages::MessageType& type, std::uint32_t queue_size,
                                 messages::MessageCallback callback, bool tcp_no_delay) override;
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

  /// Sleeps until something has come that process_input() would deliver, or for `timeout` seconds.
  void wait_for_arrival(double timeout);

  /// To be called once a step: publishes the simulation time [s] on /clock and makes it what now() returns under
  /// /use_sim_time. While a script advertises /clock itself, only the latter.
  void publish_clock(double sim_time);

  /// Publishes on /diagnostics now; for the last words of a simulation. Waits until they are sent, half a second at
  /// most.
  void publish_diagnostics();

  /// Whether the node is registered at a master that was there when last asked, four times a second.
  bool connected() const;
  std::string master_uri() const;
  /// Full name, such as `/sim_ros_interface`.
  std::string node_name() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace bubblesim
