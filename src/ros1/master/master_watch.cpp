// SPDX-License-Identifier: BSD-3-Clause
#include "master/master_watch.hpp"

#include <ros/connection_manager.h>
#include <ros/init.h>
#include <ros/names.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <ros/xmlrpc_manager.h>

#include <map>
#include <utility>
#include <vector>

#include "master/master_call.hpp"
#include "master/own_links.hpp"

namespace bubblesim {
namespace {

using XmlRpc::XmlRpcValue;

constexpr std::chrono::seconds kLookInterval{1};

struct Topic {
  std::string name;
  std::string type;
};

/// Converts the result of getPublications and getSubscriptions, a list of [topic, type].
std::vector<Topic> own_topics(const char* method) {
  RpcAnswer answer = ask_own_node(method);
  std::vector<Topic> topics;
  if (!answer.succeeded || answer.value.getType() != XmlRpcValue::TypeArray) return topics;
  for (int i = 0; i < answer.value.size(); ++i) topics.push_back({answer.value[i][0], answer.value[i][1]});
  return topics;
}

/// Adds the publishers named by the master to the connected ones. Other nodes do not register again, so the master's
/// list alone would cut live connections.
void update_publishers(const std::string& topic, XmlRpcValue& named, std::set<std::string> publishers) {
  for (int i = 0; i < named.size(); ++i) publishers.insert(static_cast<std::string>(named[i]));
  XmlRpcValue all;
  all.setSize(static_cast<int>(publishers.size()));
  int count = 0;
  for (const std::string& publisher : publishers) all[count++] = publisher;
  ask_own_node("publisherUpdate", {topic, all});
}

}  // namespace

MasterWatch::MasterWatch(std::function<void()> on_renewed)
    : on_renewed_(std::move(on_renewed)),
      services_{ros::names::resolve("~get_loggers"), ros::names::resolve("~set_logger_level")} {}

bool MasterWatch::check() {
  RpcAnswer answer = ask_master("getPid");
  if (!answer.succeeded) return false;
  const int master = answer.value;
  if (master_ == 0) master_ = master;
  const bool is_new = master != master_;
  if (ros::isShuttingDown() || (!is_new && Clock::now() < next_look_)) return true;
  next_look_ = Clock::now() + kLookInterval;
  // A new master may know only part of the node, if a registration was in progress.
  const Standing standing = ros::isStarted() ? look_up() : Standing::kReplaced;
  if (standing == Standing::kForgotten || (standing == Standing::kKnown && is_new)) {
    if (!renew()) return false;
    on_renewed_();
  }
  master_ = master;
  return true;
}

void MasterWatch::add_service(const std::string& name) { services_.insert(name); }

void MasterWatch::remove_service(const std::string& name) { services_.erase(name); }

/// Returns kReplaced if another node has the name: the master has then requested the shutdown of this node.
MasterWatch::Standing MasterWatch::look_up() const {
  RpcAnswer answer = ask_master("lookupNode", {ros::this_node::getName()});
  if (!answer.succeeded) return Standing::kForgotten;
  const bool is_own = static_cast<std::string>(answer.value) == ros::XMLRPCManager::instance()->getServerURI();
  return is_own ? Standing::kKnown : Standing::kReplaced;
}

/// Returns false if the master disappeared meanwhile. Publishers come first: if this node were already known as a
/// subscriber, the master would send it its own publishers only, which cuts the others.
bool MasterWatch::renew() const {
  const std::string uri = ros::XMLRPCManager::instance()->getServerURI();
  for (const Topic& topic : own_topics("getPublications")) {
    if (!ask_master("registerPublisher", {topic.name, topic.type, uri}).answered) return false;
  }
  const std::string address =
      "rosrpc://" + ros::network::getHost() + ":" + std::to_string(ros::ConnectionManager::instance()->getTCPPort());
  for (const std::string& service : services_) {
    if (!ask_master("registerService", {service, address, uri}).answered) return false;
  }
  const auto connected = connected_publishers();
  for (const Topic& topic : own_topics("getSubscriptions")) {
    RpcAnswer publishers = ask_master("registerSubscriber", {topic.name, topic.type, uri});
    if (!publishers.answered) return false;
    const auto links = connected.find(topic.name);
    update_publishers(topic.name, publishers.value, links == connected.end() ? std::set<std::string>{} : links->second);
  }
  return true;
}

}  // namespace bubblesim
