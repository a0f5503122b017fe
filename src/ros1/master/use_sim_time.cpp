// SPDX-License-Identifier: BSD-3-Clause
#include "master/use_sim_time.hpp"

#include <ros/names.h>

#include "master/master_call.hpp"
#include "master/node_name.hpp"

namespace bubblesim {
namespace {

using XmlRpc::XmlRpcValue;

constexpr const char* kUseSimTime = "/use_sim_time";

}  // namespace

void UseSimTime::take() {
  const std::string kept = ros::names::resolve("~use_sim_time_before");
  RpcAnswer answer = ask_master("getParam", {kept});
  if (!answer.succeeded) return;
  ask_master("deleteParam", {kept});
  if (answer.value.getType() != XmlRpcValue::TypeString) return;
  before_ = static_cast<std::string>(answer.value);
  before_.erase(before_.find_last_not_of(" \n") + 1);  // from the output of a command
}

void UseSimTime::restore() const {
  if (before_.empty() || !master_knows_this_node()) return;
  if (before_ == "true" || before_ == "false") {
    ask_master("setParam", {kUseSimTime, XmlRpcValue(before_ == "true")});
  } else if (before_ == "unset") {
    ask_master("deleteParam", {kUseSimTime});
  }
}

}  // namespace bubblesim
