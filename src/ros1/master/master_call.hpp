// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <xmlrpcpp/XmlRpcValue.h>

#include <initializer_list>
#include <string>

namespace bubblesim {

/// The response to a call to the master or to a node's own slave interface. The calls block without a time limit.
struct RpcAnswer {
  bool answered = false;   ///< false: no server
  bool succeeded = false;  ///< the first of the three values of ROS's responses
  XmlRpc::XmlRpcValue value;
};

/// Calls a method of the ROS master, with the caller's name in front of `arguments`.
/// http://wiki.ros.org/ROS/Master_API
RpcAnswer ask_master(const char* method, std::initializer_list<XmlRpc::XmlRpcValue> arguments = {});

/// Calls a method of this node's own slave interface, for data that roscpp does not provide in its own process.
/// http://wiki.ros.org/ROS/Slave_API
/// own_response() returns the response in any form: roscpp's getBusStats sends its value alone.
XmlRpc::XmlRpcValue own_response(const char* method, std::initializer_list<XmlRpc::XmlRpcValue> arguments = {});
RpcAnswer ask_own_node(const char* method, std::initializer_list<XmlRpc::XmlRpcValue> arguments = {});

}  // namespace bubblesim
