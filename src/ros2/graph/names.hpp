// SPDX-License-Identifier: BSD-3-Clause
// The names of ROS 2, and those that its middlewares make of them for DDS.
#pragma once

#include <map>
#include <stdexcept>
#include <string>

#include "bubblesim/messages/message_type.hpp"
#include "dds/participant.hpp"

namespace bubblesim::ros2 {

/// The name of this node, and the names that its command line replaces.
class Names {
 public:
  /// Takes the arguments that are for a ROS node (`topic:=other`, `__name:=`, `__node:=`, `__ns:=`, `_parameter:=`) off
  /// the command line. Throws std::invalid_argument for an invalid name.
  Names(int& argc, char** argv, const std::string& default_name);

  const std::string& node() const { return node_; }               ///< `sim_ros2_interface`
  const std::string& node_namespace() const { return space_; }    ///< `/`, `/robots`
  std::string full_node() const { return below(space_, node_); }  ///< `/robots/sim_ros2_interface`
  /// Values that the command line gives to parameters, as strings.
  const std::map<std::string, std::string>& parameters() const { return parameters_; }

  /// The full name of a topic, service (`kind` for the error text), with replacements applied. Throws
  /// std::invalid_argument with the reason.
  std::string resolve(const std::string& name, const std::string& kind) const;

 private:
  static std::string below(const std::string& space, const std::string& name);
  std::string expand(const std::string& name) const;

  std::string node_;
  std::string space_ = "/";
  std::map<std::string, std::string> replacements_;
  std::map<std::string, std::string> parameters_;
};

/// A type that this node itself uses, from the registry. Throws std::runtime_error with its name if it is not there.
template <class Type>
const Type& listed(const Type* type, const char* name) {
  if (type != nullptr) return *type;
  throw std::runtime_error(std::string(name) + " is not among the types of this build");
}

/// `/speed`, std_msgs/Float32: `rt/speed`, `std_msgs::msg::dds_::Float32_`.
TopicName message_topic(const std::string& topic, const messages::MessageType& type);
/// `/reset`, std_srvs/Empty: `rq/resetRequest`, `std_srvs::srv::dds_::Empty_Request_`.
TopicName request_topic(const std::string& service, const messages::ServiceType& type);
TopicName reply_topic(const std::string& service, const messages::ServiceType& type);

/// `std_msgs::msg::dds_::Float32_` -> `std_msgs/Float32`; others stay.
std::string message_of(const std::string& type);
/// `std_srvs::srv::dds_::Empty_Request_` -> `std_srvs/Empty`; others stay.
std::string service_of(const std::string& request_type);

}  // namespace bubblesim::ros2
