// SPDX-License-Identifier: BSD-3-Clause
#include "node_setup.hpp"

#include <ros/exception.h>
#include <ros/init.h>
#include <ros/network.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "advertised_address.hpp"
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

/// Lets roscpp, which throws otherwise, write its logs to a temporary folder if it cannot in ~/.ros.
void use_writable_home() {
  const auto is_set = [](const char* name) { return std::getenv(name) != nullptr && *std::getenv(name) != '\0'; };
  if (is_set("ROS_HOME") || is_set("ROS_LOG_DIR") || !is_set("HOME")) return;
  const std::filesystem::path home = std::filesystem::path(std::getenv("HOME")) / ".ros";
  std::error_code error;
  std::filesystem::create_directories(home, error);
  if (access(home.c_str(), W_OK | X_OK) == 0) return;
  const std::string why = error ? error.message() : std::generic_category().message(errno);
  std::string instead = std::filesystem::temp_directory_path(error) / "bubblesim-ros-XXXXXX";
  if (mkdtemp(instead.data()) == nullptr) return;
  setenv("ROS_HOME", instead.c_str(), 1);
  std::fprintf(stderr, "info: %s cannot be written (%s): ROS keeps its files in %s\n", home.c_str(), why.c_str(),
               instead.c_str());
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
  use_writable_home();
  try {
    ros::init(argc, argv, default_name, ros::init_options::NoSigintHandler);
  } catch (const ros::Exception& error) {
    throw std::invalid_argument(std::string("invalid name for the ROS node: ") + error.what());
  }
  check_peer_limits();
  limit_peer_lines();
}

}  // namespace bubblesim
