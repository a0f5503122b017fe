// SPDX-License-Identifier: BSD-3-Clause
#include "master/own_links.hpp"

#include "master/master_call.hpp"

namespace bubblesim {

std::map<std::string, std::set<std::string>> connected_publishers() {
  std::map<std::string, std::set<std::string>> publishers;
  RpcAnswer answer = ask_own_node("getBusInfo");
  if (!answer.succeeded || answer.value.getType() != XmlRpc::XmlRpcValue::TypeArray) return publishers;
  for (int i = 0; i < answer.value.size(); ++i) {
    XmlRpc::XmlRpcValue& link = answer.value[i];  // [id, node, direction, transport, topic, ...]
    if (static_cast<std::string>(link[2]) == "i") publishers[link[4]].insert(static_cast<std::string>(link[1]));
  }
  return publishers;
}

}  // namespace bubblesim
