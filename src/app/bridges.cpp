// SPDX-License-Identifier: BSD-3-Clause
#include "bridges.hpp"

#include <cstdio>
#include <exception>
#include <future>
#include <string>
#include <utility>
#include <vector>

#include "bubblesim/ros_bridge.hpp"
#include "session.hpp"
#include "shared_reports.hpp"
#include "stop_signal.hpp"

namespace bubblesim::app {
namespace {

/// What both versions of ROS take.
NodeBridgeOptions common_options(Node& node) {
  NodeBridgeOptions how;
  how.on_pause = [&node](bool paused) {
    node.runner.with([paused](Runner& runner) { return paused ? runner.pause() : runner.start(); },
                     std::future<RunState>());
  };
  how.on_step = [&node](std::uint32_t steps) {
    const auto step = [steps](Runner& runner) -> StepAnswer {
      try {
        return {"", runner.step(steps).get()};
      } catch (const std::exception& error) {
        return {error.what(), runner.frame()->time};
      }
    };
    return node.runner.with(step, StepAnswer{"another scene is being loaded", 0});
  };
  how.on_arrival = [&node] { node.runner.with([](Runner& runner) { return runner.wake(), true; }, false); };
  how.is_ending = stop_requested;
  return how;
}

RunReport take_report(Node& node) {
  RunReport report = node.runner.with([](Runner& runner) { return runner.take_report(); }, RunReport());
  report.script_errors = node.counts.failures();
  report.disabled_scripts = node.counts.disabled();
  return report;
}

RosBridgeOptions ros1_options(Node& node, const NodeBridgeOptions& common) {
  RosBridgeOptions how;
  static_cast<NodeBridgeOptions&>(how) = common;
  how.replace = node.options.replace;
  if (node.options.ros == Ros::kRos1 && has_ros2()) how.without_master = ", or use ROS 2, which needs none: --ros 2";
  how.on_shutdown = [](const std::string& why) {
    std::fprintf(stderr, "info: shutdown requested: %s\n", why.c_str());
    request_stop();
  };
  return how;
}

}  // namespace

std::vector<std::unique_ptr<NodeBridge>> make_bridges(Node& node, int& argc, char** argv) {
  const Ros ros = node.options.ros;
  std::vector<char*> arguments;  // a copy, because both sides take the same ones off
  for (int i = 0; i < argc; ++i) {
    // roslaunch names the node as its launch file does; this usual name is that of ROS 1.
    if (std::string(argv[i]) != "__name:=sim_ros_interface") arguments.push_back(argv[i]);
  }
  int count = static_cast<int>(arguments.size());
  arguments.push_back(nullptr);
  std::vector<std::unique_ptr<NodeBridge>> bridges;
  const auto reports = std::make_shared<SharedReports>([&node] { return take_report(node); }, 2);
  NodeBridgeOptions how = common_options(node);
  if (ros == Ros::kRos1 || ros == Ros::kBoth) {
    how.take_report = [reports] { return reports->take(0); };
    bridges.push_back(std::make_unique<RosBridge>(argc, argv, ros1_options(node, how)));
  }
  if (ros == Ros::kRos2 || ros == Ros::kBoth) {
    how.take_report = [reports] { return reports->take(1); };
    bridges.push_back(make_ros2_bridge(count, arguments.data(), how));
  }
  return bridges;
}

}  // namespace bubblesim::app
