// SPDX-License-Identifier: BSD-3-Clause
#include "bridge/passer.hpp"

#include <cstdio>
#include <stdexcept>
#include <utility>

#include "bubblesim/messages/registry.hpp"

namespace bubblesim::app {
namespace {

/// Topics of which late subscribers need the last message: ROS 1 does not state which those are.
const std::set<std::string> kLatched{"/map", "/map_metadata", "/robot_description", "/tf_static"};
constexpr std::uint32_t kDepth = 10;
constexpr std::uint32_t kDepthOfTransforms = 100;  // many nodes publish them

const char* name_of(const NodeBridge& side) {
  return side.version() == messages::RosVersion::kRos1 ? "ROS 1" : "ROS 2";
}

messages::Qos qos_of(const std::string& name, const NodeGraph::Topic& topic) {
  messages::Qos qos;
  qos.depth = name == "/tf" || name == "/tf_static" ? kDepthOfTransforms : kDepth;
  qos.reliable = topic.reliable;
  qos.transient_local = topic.transient_local || kLatched.count(name) != 0;
  qos.ignore_own = true;  // a topic that both sides publish would go round in circles
  return qos;
}

/// Removes the entries that are not in `there`.
template <class Passed, class There>
void forget_gone(Passed& passed, const There& there) {
  for (auto entry = passed.begin(); entry != passed.end();) {
    entry = there(entry->first) ? std::next(entry) : passed.erase(entry);
  }
}

}  // namespace

Passer::Passer(NodeBridge& ros1, NodeBridge& ros2, std::set<std::string> names)
    : names_(std::move(names)), to_ros2_{ros1, ros2, {}, {}, {}}, to_ros1_{ros2, ros1, {}, {}, {}} {}

void Passer::look() {
  const NodeGraph ros1 = to_ros2_.from.graph();
  const NodeGraph ros2 = to_ros1_.from.graph();
  look(to_ros2_, ros1, ros2);
  look(to_ros1_, ros2, ros1);
}

void Passer::update() {
  for (Direction* direction : {&to_ros2_, &to_ros1_}) {
    for (const auto& [name, topic] : direction->topics) topic->update();
  }
}

void Passer::look(Direction& direction, const NodeGraph& from, const NodeGraph& to) {
  forget_gone(direction.topics, [&from](const std::string& name) {
    const auto found = from.topics.find(name);
    return found != from.topics.end() && found->second.published;
  });
  forget_gone(direction.services, [&from](const std::string& name) { return from.services.count(name) != 0; });
  for (const auto& [name, topic] : from.topics) {
    if (topic.published && direction.topics.count(name) == 0) pass(direction, name, topic);
  }
  for (const auto& [name, type] : from.services) {
    if (direction.services.count(name) == 0 && to.services.count(name) == 0) pass(direction, name, type);
  }
}

void Passer::pass(Direction& direction, const std::string& name, const NodeGraph::Topic& topic) {
  if (!is_meant(name)) return;
  const messages::MessageType* from = messages::find_message(topic.type, direction.from.version());
  const messages::MessageType* to = messages::find_message(topic.type, direction.to.version());
  if (from == nullptr || to == nullptr) {
    return refuse(direction, name, topic.type + " is not listed in meta/messages.txt, or one side does not have it");
  }
  try {
    direction.topics.emplace(
        name, std::make_unique<PassedTopic>(name, direction.from, direction.to, *from, *to, qos_of(name, topic)));
  } catch (const std::invalid_argument& error) {
    return refuse(direction, name, error.what());
  }
  std::fprintf(stderr, "info: passing topic %s (%s) to %s\n", name.c_str(), topic.type.c_str(), name_of(direction.to));
}

void Passer::pass(Direction& direction, const std::string& name, const std::string& service_type) {
  if (!is_meant(name)) return;
  const messages::ServiceType* from = messages::find_service(service_type, direction.from.version());
  const messages::ServiceType* to = messages::find_service(service_type, direction.to.version());
  if (from == nullptr || to == nullptr) {  // most are those that each node has: parameters, loggers
    if (!names_.empty()) refuse(direction, name, service_type + " is not listed in meta/services.txt");
    return;
  }
  try {
    direction.services.emplace(name, std::make_unique<PassedService>(name, direction.from, direction.to, *from, *to));
  } catch (const std::invalid_argument& error) {
    return refuse(direction, name, error.what());
  }
  std::fprintf(stderr, "info: offering service %s (%s) to %s\n", name.c_str(), service_type.c_str(),
               name_of(direction.to));
}

/// Logs have other types, and those of actions are not passed.
bool Passer::is_meant(const std::string& name) const {
  if (!names_.empty()) return names_.count(name) != 0;
  return name != "/rosout" && name != "/rosout_agg" && name != "/parameter_events" &&
         name.find("/_action/") == std::string::npos;
}

void Passer::refuse(Direction& direction, const std::string& name, const std::string& why) {
  if (!direction.refused.insert(name).second) return;
  std::fprintf(stderr, "warning: %s of %s is not passed: %s\n", name.c_str(), name_of(direction.from), why.c_str());
}

}  // namespace bubblesim::app
