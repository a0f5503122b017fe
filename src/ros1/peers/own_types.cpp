// SPDX-License-Identifier: BSD-3-Clause
#include "peers/own_types.hpp"

#include <ros/message_traits.h>
#include <ros/service_traits.h>
#include <rosgraph_msgs/Clock.h>
#include <std_srvs/Empty.h>

namespace bubblesim {

using messages::MessageType;
using messages::ServiceType;

namespace {

template <class Message>
MessageType describe() {
  namespace traits = ros::message_traits;
  MessageType type;
  type.name = traits::datatype<Message>();
  type.type_hash = traits::md5sum<Message>();
  type.definition = traits::definition<Message>();
  return type;
}

}  // namespace

const MessageType& clock_type() {
  static const MessageType kType = describe<rosgraph_msgs::Clock>();
  return kType;
}

const ServiceType& empty_service() {
  static const MessageType kRequest = describe<std_srvs::Empty::Request>();
  static const MessageType kResponse = describe<std_srvs::Empty::Response>();
  static const ServiceType kType = [] {
    ServiceType empty;
    empty.name = ros::service_traits::datatype<std_srvs::Empty>();
    empty.type_hash = ros::service_traits::md5sum<std_srvs::Empty>();
    empty.request = &kRequest;
    empty.response = &kResponse;
    return empty;
  }();
  return kType;
}

}  // namespace bubblesim
