// SPDX-License-Identifier: BSD-3-Clause
#include "status/graph_reader.hpp"

#include <ros/this_node.h>

#include <chrono>
#include <utility>

#include "master/master_call.hpp"
#include "services/service_call.hpp"

namespace bubblesim {
namespace {

using XmlRpc::XmlRpcValue;

constexpr std::chrono::milliseconds kServiceTimeout{200};  // of a service's server

/// Calls `note` with the names of [[name, [node, ...]], ...] that other nodes have.
template <class Note>
void each_of_others(XmlRpcValue& entries, Note note) {
  for (int i = 0; i < entries.size(); ++i) {
    XmlRpcValue& nodes = entries[i][1];
    bool of_other = false;
    for (int k = 0; k < nodes.size(); ++k) of_other |= static_cast<std::string>(nodes[k]) != ros::this_node::getName();
    if (of_other) note(static_cast<std::string>(entries[i][0]));
  }
}

}  // namespace

NodeGraph GraphReader::read() {
  NodeGraph graph;
  RpcAnswer state = ask_master("getSystemState");
  RpcAnswer types = ask_master("getTopicTypes");
  if (!state.succeeded || !types.succeeded) return graph;
  each_of_others(state.value[0], [&graph](const std::string& topic) { graph.topics[topic].published = true; });
  each_of_others(state.value[1], [&graph](const std::string& topic) { graph.topics[topic].subscribed = true; });
  for (int i = 0; i < types.value.size(); ++i) {
    const auto topic = graph.topics.find(types.value[i][0]);
    if (topic != graph.topics.end()) topic->second.type = static_cast<std::string>(types.value[i][1]);
  }
  std::map<std::string, std::string> known = std::exchange(service_types_, {});
  each_of_others(state.value[2], [&](const std::string& service) {
    std::string type = known[service];
    if (type.empty()) type = type_of_service(service, Deadline(Deadline::Clock::now() + kServiceTimeout));
    if (type.empty()) return;
    graph.services[service] = type;
    service_types_[service] = std::move(type);
  });
  return graph;
}

}  // namespace bubblesim
