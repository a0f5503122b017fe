// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>

#include "bridge/passed_service.hpp"
#include "bridge/passed_topic.hpp"
#include "bubblesim/node_bridge.hpp"

namespace bubblesim::app {

/// Passes topics and services between ROS 1 and ROS 2, both ways.
class Passer {
 public:
  /// `names`: of topics and services, full ones; empty: all whose type both sides have.
  Passer(NodeBridge& ros1, NodeBridge& ros2, std::set<std::string> names);

  /// Looks which topics and services there are now. Waits for the master of ROS 1.
  void look();
  /// Subscribes to what has subscribers on the other side.
  void update();

 private:
  struct Direction {
    NodeBridge& from;
    NodeBridge& to;
    std::map<std::string, std::unique_ptr<PassedTopic>> topics;
    std::map<std::string, std::unique_ptr<PassedService>> services;
    std::set<std::string> refused;  // names whose problem was reported
  };

  void look(Direction& direction, const NodeGraph& from, const NodeGraph& to);
  void pass(Direction& direction, const std::string& name, const NodeGraph::Topic& topic);
  void pass(Direction& direction, const std::string& name, const std::string& service_type);
  bool is_meant(const std::string& name) const;
  void refuse(Direction& direction, const std::string& name, const std::string& why);

  const std::set<std::string> names_;
  Direction to_ros2_;
  Direction to_ros1_;
};

}  // namespace bubblesim::app
