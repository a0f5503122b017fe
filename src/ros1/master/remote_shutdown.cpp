// SPDX-License-Identifier: BSD-3-Clause
#include "master/remote_shutdown.hpp"

#include <ros/xmlrpc_manager.h>

#include <utility>

namespace bubblesim {
namespace {

using XmlRpc::XmlRpcValue;

/// An argument of a call from any client.
std::string text_at(XmlRpcValue& arguments, int index) {
  if (arguments.getType() != XmlRpcValue::TypeArray || arguments.size() <= index) return {};
  return arguments[index].getType() == XmlRpcValue::TypeString ? static_cast<std::string>(arguments[index])
                                                               : std::string();
}

}  // namespace

void take_over_shutdown(std::function<void(const std::string& why)> on_shutdown) {
  // roscpp binds its own method in ros::start(), which does nothing if one is already bound.
  ros::XMLRPCManager::instance()->bind(
      "shutdown", [on_shutdown = std::move(on_shutdown)](XmlRpcValue& arguments, XmlRpcValue& result) {
        const std::string caller = text_at(arguments, 0);
        const std::string reason = text_at(arguments, 1);
        on_shutdown((caller.empty() ? "unknown" : caller) + ": " + (reason.empty() ? "no reason given" : reason));
        result = ros::xmlrpc::responseInt(1, "", 0);
      });
}

}  // namespace bubblesim
