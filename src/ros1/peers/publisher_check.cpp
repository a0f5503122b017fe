// SPDX-License-Identifier: BSD-3-Clause
#include "peers/publisher_check.hpp"

#include <ros/this_node.h>

#include <algorithm>
#include <iterator>
#include <vector>

#include "console/log_line.hpp"
#include "master/master_call.hpp"
#include "master/own_links.hpp"
#include "peers/publisher_probe.hpp"

namespace bubblesim {
namespace {

constexpr std::chrono::seconds kPublisherCheckInterval{1};

std::vector<std::string> others(XmlRpc::XmlRpcValue& nodes) {
  std::vector<std::string> names(static_cast<std::size_t>(nodes.size()));
  for (int i = 0; i < nodes.size(); ++i) names[static_cast<std::size_t>(i)] = static_cast<std::string>(nodes[i]);
  names.erase(std::remove(names.begin(), names.end(), ros::this_node::getName()), names.end());
  return names;
}

void ask(const std::string& topic, const std::string& node, const std::string& uri, const TypeVersion& ours) {
  probe_publisher(topic, uri, [topic, node, ours](const TypeVersion& theirs) {
    if (theirs.type_hash == ours.type_hash || theirs.type_hash == "*") return;
    log_line("topic '" + topic + "': node " + node + " publishes " + shown(theirs) + ", but this node subscribes to " +
             shown(ours) + ", so no messages arrive from it; " + cure(theirs, ours));
  });
}

}  // namespace

void PublisherCheck::add(const std::string& topic, const messages::MessageType& type) {
  Subscribed& subscribed = topics_[topic];
  subscribed.type = {type.name, type.type_hash};
  ++subscribed.count;
}

void PublisherCheck::remove(const std::string& topic) {
  const auto found = topics_.find(topic);
  if (found != topics_.end() && --found->second.count == 0) topics_.erase(found);
}

void PublisherCheck::look() {
  if (topics_.empty() || Clock::now() < next_look_) return;
  next_look_ = Clock::now() + kPublisherCheckInterval;
  const std::set<Publisher> missing = missing_publishers();
  std::set<Publisher> asked;  // without nodes that have disappeared
  std::set_intersection(asked_.begin(), asked_.end(), missing.begin(), missing.end(),
                        std::inserter(asked, asked.end()));
  for (const Publisher& publisher : missing) {
    if (missing_.count(publisher) == 0 || !asked.insert(publisher).second) continue;
    const auto& [topic, node, uri] = publisher;
    ask(topic, node, uri, topics_.at(topic).type);
  }
  missing_ = missing;
  asked_ = std::move(asked);
}

std::set<PublisherCheck::Publisher> PublisherCheck::missing_publishers() const {
  std::set<Publisher> missing;
  RpcAnswer answer = ask_master("getSystemState");
  if (!answer.succeeded) return missing;
  const auto connected = connected_publishers();
  XmlRpc::XmlRpcValue& topics = answer.value[0];  // [[topic, [node, ...]], ...]
  for (int i = 0; i < topics.size(); ++i) {
    const std::string topic = topics[i][0];
    if (topics_.count(topic) == 0) continue;
    const std::vector<std::string> nodes = others(topics[i][1]);
    const auto found = connected.find(topic);
    const std::set<std::string> links = found == connected.end() ? std::set<std::string>() : found->second;
    if (links.size() >= nodes.size()) continue;
    for (const std::string& node : nodes) {
      RpcAnswer uri = ask_master("lookupNode", {node});
      if (!uri.succeeded || links.count(uri.value) != 0) continue;
      missing.emplace(topic, node, static_cast<std::string>(uri.value));
    }
  }
  return missing;
}

}  // namespace bubblesim
