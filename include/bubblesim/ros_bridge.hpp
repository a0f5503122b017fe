// SPDX-License-Identifier: BSD-3-Clause
// The simulator as a ROS 1 node: transfers the messages of child scripts, publishes /clock, provides ROS time.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "bubblesim/messages/bridge.hpp"
#include "bubblesim/run_report.hpp"

namespace bubblesim {

struct StepAnswer {
  std::string problem;  ///< why not all steps were run; empty if they were
  double time = 0;      ///< s, simulation time after the last step
};

struct RosBridgeOptions {
  /// Name of the node, unless the command line has `__name:=other`.
  std::string node_name = "sim_ros_interface";
  /// Called from process_input(): with true when the service ~pause is called, with false for ~unpause (both
  /// std_srvs/Empty). If empty, the services are not advertised.
  std::function<void(bool paused)> on_pause;
  /// Called on another thread when the service ~step (bubblesim_msgs/Step) is called; returns when the steps are done.
  /// If empty, the service is not advertised.
  std::function<StepAnswer(std::uint32_t steps)> on_step;
  /// Called on another thread when process_input() has something to deliver.
  std::function<void()> on_arrival;
  /// If another node on the master has the same name, take over the name, which ends that node. If false, such a name
  /// is an error.
  bool replace = false;
  /// Called on a thread of roscpp when the node is asked to shut down: by `rosnode kill`, or by the master when another
  /// node takes the name. The string states by whom and why. If empty, roscpp shuts down and the process goes on.
  std::function<void(const std::string& why)> on_shutdown;
  /// Polled while a service call waits; when it returns true (the process is ending), the call is aborted.
  std::function<bool()> is_ending;
  /// Called on another thread once a second; the result is published on /diagnostics. If empty, nothing is published
  /// there.
  std::function<RunReport()> take_report;
};

/// At most one per process, because roscpp is global. All calls come from the simulation's thread. Calls that may wait
/// for the master run on a thread of the bridge, so ROS never blocks the simulation. When the master restarts or drops
/// the node, everything is registered again within half a second of the master's first answer (within a second if it
/// only dropped the node); messages to and from connected nodes keep flowing.
class RosBridge final : public messages::Bridge {
 public:
  /// Removes the remappings (`a:=b`, `__name:=`, `__ns:=`, `__master:=`) from the command line. If a master answers
  /// within a second, returns connected. Otherwise prints a line on stderr with the URI and the remedy, and connects as
  /// soon as a master appears. The default of ROS_MASTER_URI is http://localhost:11311. Throws std::invalid_argument
  /// for an invalid master URI or node name, and for a name that another node on that master has; std::logic_error for
  /// a second bridge. If a master appears later and another node on it has the name, the bridge reports this once and
  /// connects when that node has ended.
  RosBridge(int& argc, char** argv, RosBridgeOptions options = {});

  /// Unregisters everything from the master. Returns within 2 s even if the master is gone or does not respond.
  ~RosBridge() override;

  /// Unregisters everything from the master, as the destructor does. Thread-safe; for use before the process is killed.
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

  /// Publishes the time of the simulation's state [s] on /clock and makes now() return it under /use_sim_time. While a
  /// script advertises /clock itself, does not publish.
  void publish_clock(double sim_time);

  /// Shuts down all publishers, subscribers, servers and clients of the functions above: those of a scene that ends.
  void shutdown_endpoints();

  /// Publishes on /diagnostics immediately, for the final report of a simulation. Waits until the message is sent, at
  /// most half a second.
  void publish_diagnostics();

  /// Whether the node is registered at a master that responded to the last check (four checks a second).
  bool connected() const;
  std::string master_uri() const;
  /// Full name, such as `/sim_ros_interface`.
  std::string node_name() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace bubblesim
