// SPDX-License-Identifier: BSD-3-Clause
#include "master/node_name.hpp"

#include <ros/master.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <ros/xmlrpc_manager.h>
#include <xmlrpcpp/XmlRpcClient.h>
#include <xmlrpcpp/XmlRpcDispatch.h>

#include <chrono>
#include <cstdint>
#include <stdexcept>
#include <thread>

#include "master/master_call.hpp"
#include "master/timed_socket.hpp"

namespace bubblesim {
namespace {

constexpr std::chrono::milliseconds kAnswerTime{1000};
constexpr std::chrono::milliseconds kTimeToEnd{3000};
constexpr std::chrono::milliseconds kBetweenLooks{20};

/// The URI of a node, by default of that with this node's name, on the master; empty if there is none.
std::string registered_uri(const std::string& node = ros::this_node::getName()) {
  RpcAnswer answer = ask_master("lookupNode", {node});
  if (!answer.succeeded || answer.value.getType() != XmlRpc::XmlRpcValue::TypeString) return {};
  return answer.value;
}

/// A client whose calls return even if the node hangs.
class TimedClient final : public XmlRpc::XmlRpcClient {
 public:
  TimedClient(const std::string& host, std::uint32_t port) : XmlRpcClient(host.c_str(), static_cast<int>(port), "/") {}

  void call(const char* method, const XmlRpc::XmlRpcValue& arguments) {
    if (!executeNonBlock(method, arguments)) return;
    _disp.addSource(this, XmlRpc::XmlRpcDispatch::WritableEvent | XmlRpc::XmlRpcDispatch::Exception);
    _disp.work(std::chrono::duration<double>(kAnswerTime).count());
    _disp.removeSource(this);
  }
};

/// A node stopped by a signal still does.
bool takes_connections(const std::string& uri) {
  std::string host;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(uri, host, port)) return false;
  try {
    const TimedSocket socket(host, port, Deadline(Deadline::Clock::now() + kAnswerTime));
    return true;
  } catch (const std::runtime_error&) {
    return false;
  }
}

}  // namespace

bool node_takes_connections(const std::string& node) {
  const std::string uri = registered_uri(node);
  return !uri.empty() && takes_connections(uri);
}

std::string other_node_of_this_name() {
  const std::string uri = registered_uri();
  if (uri.empty() || !takes_connections(uri)) return {};
  return "a node " + ros::this_node::getName() + " is already running on the ROS master " + ros::master::getURI() +
         ": shut it down with --replace, or run beside it, with a master of its own: bubblesim run SCENE --isolated";
}

void end_other_node_of_this_name() {
  const std::string uri = registered_uri();
  std::string host;
  std::uint32_t port = 0;
  if (uri.empty() || !ros::network::splitURI(uri, host, port) || !takes_connections(uri)) return;
  XmlRpc::XmlRpcValue arguments;
  arguments[0] = ros::this_node::getName();
  arguments[1] = "another node takes this name";
  TimedClient(host, port).call("shutdown", arguments);
  const auto end = Deadline::Clock::now() + kTimeToEnd;
  while (takes_connections(uri) && Deadline::Clock::now() < end) std::this_thread::sleep_for(kBetweenLooks);
}

bool master_knows_this_node() { return registered_uri() == ros::XMLRPCManager::instance()->getServerURI(); }

}  // namespace bubblesim
