// SPDX-License-Identifier: BSD-3-Clause
#include "peers/publisher_probe.hpp"

#include <ros/connection.h>
#include <ros/connection_manager.h>
#include <ros/header.h>
#include <ros/network.h>
#include <ros/poll_manager.h>
#include <ros/this_node.h>
#include <ros/transport/transport_tcp.h>
#include <ros/xmlrpc_manager.h>
#include <xmlrpcpp/XmlRpc.h>

#include <memory>
#include <utility>

namespace bubblesim {
namespace {

using Answer = std::function<void(const TypeVersion&)>;
using XmlRpc::XmlRpcValue;

void connect(const std::string& topic, const std::string& host, int port, Answer on_answer) {
  const auto transport = boost::make_shared<ros::TransportTCP>(&ros::PollManager::instance()->getPollSet());
  if (!transport->connect(host, port)) return;
  const auto connection = boost::make_shared<ros::Connection>();
  connection->initialize(transport, false, ros::HeaderReceivedFunc());
  connection->setHeaderReceivedCallback(
      [on_answer = std::move(on_answer)](const ros::ConnectionPtr& answered, const ros::Header& header) {
        TypeVersion type;
        if (header.getValue("type", type.name) && header.getValue("md5sum", type.type_hash)) on_answer(type);
        answered->drop(ros::Connection::Destructing);
        return false;
      });
  const ros::M_string header{
      {"topic", topic}, {"md5sum", "*"}, {"type", "*"}, {"callerid", ros::this_node::getName()}, {"tcp_nodelay", "0"}};
  connection->writeHeader(header, [](const ros::ConnectionPtr&) {});
  ros::ConnectionManager::instance()->addConnection(connection);
}

/// Asks the node for its TCPROS address, as roscpp does.
/// http://wiki.ros.org/ROS/Slave_API, requestTopic
class TopicRequest final : public ros::ASyncXMLRPCConnection {
 public:
  TopicRequest(std::string topic, const std::string& host, std::uint32_t port, Answer on_answer)
      : topic_(std::move(topic)),
        client_(host.c_str(), static_cast<int>(port), "/"),
        on_answer_(std::move(on_answer)) {}

  bool begin() {
    XmlRpcValue arguments;
    arguments[0] = ros::this_node::getName();
    arguments[1] = topic_;
    arguments[2][0][0] = "TCPROS";
    return client_.executeNonBlock("requestTopic", arguments);
  }

  void addToDispatch(XmlRpc::XmlRpcDispatch* dispatch) override {
    dispatch->addSource(&client_, XmlRpc::XmlRpcDispatch::WritableEvent | XmlRpc::XmlRpcDispatch::Exception);
  }

  void removeFromDispatch(XmlRpc::XmlRpcDispatch* dispatch) override { dispatch->removeSource(&client_); }

  /// Whether the request has ended.
  bool check() override {
    XmlRpcValue response;
    if (!client_.executeCheckDone(response)) return false;
    XmlRpcValue protocol;  // [TCPROS, host, port]
    if (!ros::XMLRPCManager::instance()->validateXmlrpcResponse("requestTopic", response, protocol)) return true;
    if (protocol.getType() != XmlRpcValue::TypeArray || protocol.size() != 3 ||
        protocol[1].getType() != XmlRpcValue::TypeString || protocol[2].getType() != XmlRpcValue::TypeInt) {
      return true;
    }
    connect(topic_, protocol[1], protocol[2], std::move(on_answer_));
    return true;
  }

 private:
  const std::string topic_;
  XmlRpc::XmlRpcClient client_;
  Answer on_answer_;
};

}  // namespace

void probe_publisher(const std::string& topic, const std::string& node_uri, Answer on_answer) {
  std::string host;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(node_uri, host, port)) return;
  const auto request = boost::make_shared<TopicRequest>(topic, host, port, std::move(on_answer));
  if (request->begin()) ros::XMLRPCManager::instance()->addASyncConnection(request);
}

}  // namespace bubblesim
