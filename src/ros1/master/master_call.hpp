// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <xmlrpcpp/XmlRpcValue.h>

#include <initializer_list>
#include <string>

namespace bubblesim {

/// What a call to the master or to a node's own slave interface brought. They block without a time limit.
struct RpcAnswer {
  bool answered = false;   ///< false: nobody there
  bool succeeded = false;  ///< the first of the three values of ROS's answers
  XmlRpc::XmlRpcValue value;
};

/// A method of the ROS master; the caller's name is put in front of `arguments`.
/// http://wiki.ros.org/ROS/Master_API
RpcAnswer ask_master(const char* method, std::initializer_list<XmlRpc::XmlRpcValue> arguments = {});

/// A method of this node itself, for what roscpp tells others but not its own process.
/// http://wiki.ros.org/ROS/Slave_API
/// own_response() is what came, whatever its form: getBusStats of roscpp sends its value alone.
XmlRpc::XmlRpcValue own_response(const char* method, std::initializer_list<XmlRpc::XmlRpcValue> arguments = {});
RpcAnswer ask_own_node(const char* method, std::initializer_list<XmlRpc::XmlRpcValue> arguments = {});

}  // namespace bubblesim
