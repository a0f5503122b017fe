// SPDX-License-Identifier: BSD-3-Clause
#include "master/other_clock.hpp"

#include <ros/master.h>
#include <ros/this_node.h>

#include <set>

#include "master/master_call.hpp"
#include "master/node_name.hpp"

namespace bubblesim {
namespace {

using XmlRpc::XmlRpcValue;

/// The names in [[name, [node, ...]], ...].
std::set<std::string> nodes_of(XmlRpcValue& entries, const std::string& topic) {
  std::set<std::string> nodes;
  for (int i = 0; i < entries.size(); ++i) {
    if (static_cast<std::string>(entries[i][0]) != topic) continue;
    for (int k = 0; k < entries[i][1].size(); ++k) nodes.insert(entries[i][1][k]);
  }
  return nodes;
}

/// What advances a time can be paused: ~pause here, /gazebo/pause_physics, ~pause_playback of rosbag. The bridge
/// between ROS 1 and ROS 2 publishes a time and cannot.
bool can_be_paused(XmlRpcValue& services, const std::string& node) {
  const std::string start = node + "/pause";
  for (int i = 0; i < services.size(); ++i) {
    if (static_cast<std::string>(services[i][0]).compare(0, start.size(), start) == 0) return true;
  }
  return false;
}

}  // namespace

std::string other_time_on(const std::string& topic) {
  RpcAnswer state = ask_master("getSystemState");
  if (!state.succeeded || state.value.getType() != XmlRpcValue::TypeArray || state.value.size() != 3) return {};
  for (const std::string& node : nodes_of(state.value[0], topic)) {
    if (node == ros::this_node::getName() || !can_be_paused(state.value[2], node) || !node_takes_connections(node)) {
      continue;
    }
    return node + " publishes " + topic + " on the ROS master " + ros::master::getURI() +
           ", and nodes cannot follow two times: end it (rosnode kill " + node +
           "), use a master of its own (bubblesim run SCENE --isolated), or give this node other topics: " + topic +
           ":=/other" + topic + " /tf:=/other/tf";
  }
  return {};
}

}  // namespace bubblesim
