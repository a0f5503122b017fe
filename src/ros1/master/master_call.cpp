// SPDX-License-Identifier: BSD-3-Clause
#include "master/master_call.hpp"

#include <ros/master.h>
#include <ros/this_node.h>
#include <ros/xmlrpc_manager.h>
#include <xmlrpcpp/XmlRpc.h>

namespace bubblesim {
namespace {

using XmlRpc::XmlRpcValue;

XmlRpcValue with_caller(std::initializer_list<XmlRpcValue> arguments) {
  XmlRpcValue all;
  int count = 0;
  all[count++] = ros::this_node::getName();
  for (const XmlRpcValue& argument : arguments) all[count++] = argument;
  return all;
}

RpcAnswer read_answer(XmlRpcValue& response) {
  RpcAnswer answer;
  if (response.getType() != XmlRpcValue::TypeArray || response.size() != 3) return answer;
  if (response[0].getType() != XmlRpcValue::TypeInt) return answer;
  answer.answered = true;
  answer.succeeded = static_cast<int&>(response[0]) == 1;
  answer.value = response[2];
  return answer;
}

}  // namespace

RpcAnswer ask_master(const char* method, std::initializer_list<XmlRpcValue> arguments) {
  XmlRpcValue response;
  XmlRpcValue payload;
  ros::master::execute(method, with_caller(arguments), response, payload, false);
  return read_answer(response);
}

XmlRpcValue own_response(const char* method, std::initializer_list<XmlRpcValue> arguments) {
  const auto& manager = ros::XMLRPCManager::instance();
  XmlRpc::XmlRpcClient* client = manager->getXMLRPCClient("localhost", static_cast<int>(manager->getServerPort()), "/");
  XmlRpcValue response;
  if (!client->execute(method, with_caller(arguments), response)) response.clear();
  manager->releaseXMLRPCClient(client);
  return response;
}

RpcAnswer ask_own_node(const char* method, std::initializer_list<XmlRpcValue> arguments) {
  XmlRpcValue response = own_response(method, arguments);
  return read_answer(response);
}

}  // namespace bubblesim
