// SPDX-License-Identifier: BSD-3-Clause
#include "master/parameters.hpp"

#include <ros/master.h>

#include <cstdio>
#include <memory>
#include <stdexcept>
#include <variant>

#include "master/master_thread.hpp"
#include "master/names.hpp"

namespace bubblesim {
namespace {

using messages::ParameterValue;
using XmlRpc::XmlRpcValue;

constexpr std::chrono::milliseconds kTimeout{1000};

ParameterValue to_parameter(XmlRpcValue& value) {
  switch (value.getType()) {
    case XmlRpcValue::TypeBoolean:
      return static_cast<bool>(value);
    case XmlRpcValue::TypeInt:
      return static_cast<std::int32_t>(static_cast<int>(value));
    case XmlRpcValue::TypeDouble:
      return static_cast<double>(value);
    case XmlRpcValue::TypeString:
      return static_cast<std::string>(value);
    default:
      return std::monostate();
  }
}

struct ToXml {
  XmlRpcValue operator()(std::monostate) const { throw std::invalid_argument("a parameter must have a value"); }
  template <class T>
  XmlRpcValue operator()(const T& value) const {
    return XmlRpcValue(value);
  }
};

}  // namespace

std::optional<ParameterValue> Parameters::get(const std::string& name) {
  RpcAnswer answer = ask("getParam", resolve_name(name, "parameter"));
  if (!answer.succeeded) return std::nullopt;
  return to_parameter(answer.value);
}

void Parameters::set(const std::string& name, const ParameterValue& value) {
  const XmlRpcValue xml = std::visit(ToXml(), value);
  master_.post([name = resolve_name(name, "parameter"), xml] {
    if (ask_master("setParam", {name, xml}).succeeded) return;
    std::fprintf(stderr, "warning: the ROS master refused to set the parameter '%s'\n", name.c_str());
  });
}

void Parameters::remove(const std::string& name) {
  master_.post([name = resolve_name(name, "parameter")] { ask_master("deleteParam", {name}); });
}

std::optional<std::string> Parameters::search(const std::string& name) {
  resolve_name(name, "parameter");  // throws for an invalid name
  RpcAnswer answer = ask("searchParam", name);
  if (!answer.succeeded || answer.value.getType() != XmlRpcValue::TypeString) return std::nullopt;
  return static_cast<std::string>(answer.value);
}

RpcAnswer Parameters::ask(const char* method, const std::string& argument) {
  const auto answer = std::make_shared<RpcAnswer>();  // shared with the job, which may outlive this call
  const bool asked = master_.run([answer, method, argument] { *answer = ask_master(method, {argument}); }, kTimeout);
  if (!asked || !answer->answered)
    throw messages::NoParameterServer("the ROS master at " + ros::master::getURI() + " does not answer");
  return *answer;
}

}  // namespace bubblesim
