// SPDX-License-Identifier: BSD-3-Clause
#include "node_setup.hpp"

#include <ros/exception.h>
#include <ros/init.h>
#include <ros/network.h>

#include <cstdlib>
#include <stdexcept>
#include <string_view>

#include "advertised_address.hpp"
#include "bubblesim/ros_home.hpp"
#include "peer_limits.hpp"
#include "peer_lines.hpp"

namespace bubblesim {
namespace {

constexpr const char* kMasterVariable = "ROS_MASTER_URI";
constexpr const char* kUsualMaster = "http://localhost:11311";

/// The URI that roscpp will use: the last `__master:=` of the command line, otherwise the environment's.
std::string chosen_master(int argc, char** argv) {
  constexpr std::string_view kRemapping = "__master:=";
  std::string uri = std::getenv(kMasterVariable);
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (argument.substr(0, kRemapping.size()) == kRemapping) uri = argument.substr(kRemapping.size());
  }
  return uri;
}

}  // namespace

void init_node(int& argc, char** argv, const std::string& default_name) {
  if (ros::isInitialized()) throw std::logic_error("a process can have only one ROS node: a bridge exists already");
  setenv(kMasterVariable, kUsualMaster, 0);
  const std::string uri = chosen_master(argc, argv);
  std::string host;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(uri, host, port) || host.empty() || port == 0 || port > 65535) {
    throw std::invalid_argument("invalid ROS master URI '" + uri + "': set " + kMasterVariable + " to something like " +
                                kUsualMaster);
  }
  stay_on_this_machine(argc, argv);
  use_writable_ros_home();
  try {
    ros::init(argc, argv, default_name, ros::init_options::NoSigintHandler);
  } catch (const ros::Exception& error) {
    throw std::invalid_argument(std::string("invalid name for the ROS node: ") + error.what());
  }
  check_peer_limits();
  limit_peer_lines();
}

}  // namespace bubblesim
