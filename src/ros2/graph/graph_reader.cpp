// SPDX-License-Identifier: BSD-3-Clause
#include "graph/graph_reader.hpp"

#include <string>
#include <string_view>

#include "graph/names.hpp"

namespace bubblesim::ros2 {
namespace {

constexpr std::string_view kRequest = "Request";

bool begins_with(const std::string& text, std::string_view beginning) {
  return text.compare(0, beginning.size(), beginning) == 0;
}

/// `rq/resetRequest` -> `/reset`; empty for other topics.
std::string service_name(const std::string& topic) {
  if (!begins_with(topic, "rq/") || topic.size() < 3 + kRequest.size()) return {};
  const std::size_t end = topic.size() - kRequest.size();
  return topic.compare(end, kRequest.size(), kRequest) == 0 ? topic.substr(2, end - 2) : std::string();
}

NodeGraph::Topic* topic_of(NodeGraph& graph, const DiscoveredEndpoint& endpoint) {
  if (!begins_with(endpoint.topic, "rt/")) return nullptr;
  NodeGraph::Topic& topic = graph.topics[endpoint.topic.substr(2)];
  topic.type = message_of(endpoint.type);
  return &topic;
}

}  // namespace

NodeGraph read_graph(const Participant& participant) {
  NodeGraph graph;
  for (const DiscoveredEndpoint& writer : participant.remote_writers()) {
    NodeGraph::Topic* topic = topic_of(graph, writer);
    if (topic == nullptr) continue;
    topic->published = true;
    topic->reliable = topic->reliable && writer.reliable;
    topic->transient_local = topic->transient_local || writer.transient_local;
  }
  for (const DiscoveredEndpoint& reader : participant.remote_readers()) {
    if (NodeGraph::Topic* topic = topic_of(graph, reader)) topic->subscribed = true;
    if (std::string name = service_name(reader.topic); !name.empty()) graph.services[name] = service_of(reader.type);
  }
  return graph;
}

}  // namespace bubblesim::ros2
