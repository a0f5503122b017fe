// SPDX-License-Identifier: BSD-3-Clause
#include "ros_args.hpp"

#include <set>
#include <stdexcept>

namespace bubblesim::app {
namespace {

const std::set<std::string> kRemap{"-r", "--remap"};
const std::set<std::string> kParameter{"-p", "--param"};
const std::set<std::string> kWithValue{"--log-level", "--log-config-file", "-e", "--enclave"};
const std::set<std::string> kFlags{"--enable-rosout-logs",       "--disable-rosout-logs",
                                   "--enable-stdout-logs",       "--disable-stdout-logs",
                                   "--enable-external-lib-logs", "--disable-external-lib-logs"};

/// `node:rule` -> `rule`.
std::string without_node(const std::string& rule) {
  const std::size_t colon = rule.find(':');
  const bool has_node = colon != std::string::npos && rule.compare(colon, 2, ":=") != 0;
  return has_node ? rule.substr(colon + 1) : rule;
}

std::string plain(const std::string& option, const std::string& given) {
  if (given.find(":=") == std::string::npos) {
    throw std::invalid_argument(option + " needs NAME:=VALUE, found '" + given + "'");
  }
  const std::string rule = without_node(given);
  return kParameter.count(option) != 0 ? "_" + rule : rule;
}

}  // namespace

std::vector<std::string> with_plain_ros_args(int argc, char** argv) {
  std::vector<std::string> arguments;
  bool is_ros = false;
  for (int i = 0; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--ros-args" || (is_ros && argument == "--")) {
      is_ros = argument != "--";
    } else if (!is_ros) {
      arguments.push_back(argument);
    } else if (kFlags.count(argument) == 0) {
      const bool is_rule = kRemap.count(argument) != 0 || kParameter.count(argument) != 0;
      if (!is_rule && kWithValue.count(argument) == 0) {
        throw std::invalid_argument("--ros-args: '" + argument + "' is not supported; -r, -p and those for logs are");
      }
      if (++i == argc) throw std::invalid_argument("--ros-args: " + argument + " needs a value");
      if (is_rule) arguments.push_back(plain(argument, argv[i]));
    }
  }
  return arguments;
}

}  // namespace bubblesim::app
