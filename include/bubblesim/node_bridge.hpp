// SPDX-License-Identifier: BSD-3-Clause
// What the simulator's node needs of a bridge, besides the topics and services of scripts and plugins.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "bubblesim/messages/bridge.hpp"
#include "bubblesim/node_graph.hpp"
#include "bubblesim/run_report.hpp"

namespace bubblesim {

struct StepAnswer {
  std::string problem;  ///< why not all steps were run; empty if they were
  double time = 0;      ///< s, simulation time after the last step
};

struct NodeBridgeOptions {
  /// Name of the node, unless the command line has `__name:=other`; empty: that of the bridge.
  std::string node_name;
  /// Called from process_input(): with true when the service ~pause is called, with false for ~unpause (both
  /// std_srvs/Empty). If empty, the services are not advertised.
  std::function<void(bool paused)> on_pause;
  /// Called on another thread when the service ~step (bubblesim_msgs/Step) is called; returns when the steps are done.
  /// If empty, the service is not advertised.
  std::function<StepAnswer(std::uint32_t steps)> on_step;
  /// Called on another thread when process_input() has something to deliver.
  std::function<void()> on_arrival;
  /// Polled while a service call waits; when it returns true (the process is ending), the call is aborted.
  std::function<bool()> is_ending;
  /// Called on another thread once a second; the result is published on /diagnostics. If empty, nothing is published
  /// there.
  std::function<RunReport()> take_report;
};

class NodeBridge : public messages::Bridge {
 public:
  /// Publishes the time of the simulation's state [s] on /clock and makes now() return it under use_sim_time. While a
  /// script advertises /clock itself, does not publish.
  virtual void publish_clock(double sim_time) = 0;

  /// Shuts down all publishers, subscribers, servers and clients of scripts and plugins: those of a scene that ends.
  virtual void shutdown_endpoints() = 0;

  /// Publishes on /diagnostics immediately, for the final report of a simulation. Waits until the message is sent, at
  /// most half a second.
  virtual void publish_diagnostics() = 0;

  /// Leaves the network, as the destructor does. Thread-safe; for use before the process is killed. Returns whether all
  /// is done.
  virtual bool leave() = 0;

  /// The other nodes' topics and services. Waits for the master of ROS 1, at most two seconds; empty without one.
  virtual NodeGraph graph() = 0;

  /// Full name, such as `/sim_ros_interface`.
  virtual std::string node_name() const = 0;
};

}  // namespace bubblesim
