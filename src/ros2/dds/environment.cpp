// SPDX-License-Identifier: BSD-3-Clause
#include "dds/environment.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

#include "bubblesim/messages/registry.hpp"

namespace bubblesim::ros2 {
namespace {

constexpr int kLastDomain = 232;  // the ports of a later one would be above 65535
constexpr std::size_t kOldGidSize = 24;

std::string_view variable(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

int read_domain() {
  const std::string_view text = variable("ROS_DOMAIN_ID");
  if (text.empty()) return 0;
  int domain = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), domain);
  if (error == std::errc() && end == text.data() + text.size() && domain >= 0 && domain <= kLastDomain) return domain;
  throw std::invalid_argument("ROS_DOMAIN_ID must be 0 to " + std::to_string(kLastDomain) + ", found '" +
                              std::string(text) + "'");
}

Range read_range() {
  if (variable("ROS_LOCALHOST_ONLY") == "1") return Range::kLocalhost;
  const std::string_view text = variable("ROS_AUTOMATIC_DISCOVERY_RANGE");
  if (text.empty() || text == "LOCALHOST") return Range::kLocalhost;
  if (text == "SUBNET" || text == "SYSTEM_DEFAULT") return Range::kSubnet;
  if (text == "OFF") return Range::kOff;
  throw std::invalid_argument(
      "ROS_AUTOMATIC_DISCOVERY_RANGE must be OFF, LOCALHOST, SUBNET or SYSTEM_DEFAULT, found '" + std::string(text) +
      "'");
}

std::vector<std::string> read_peers() {
  std::vector<std::string> peers;
  std::string_view rest = variable("ROS_STATIC_PEERS");
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(';'), rest.size());
    if (end > 0) peers.emplace_back(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return peers;
}

}  // namespace

Environment read_environment() {
  Environment environment;
  environment.domain = read_domain();
  environment.range = read_range();
  if (environment.range != Range::kOff && variable("ROS_LOCALHOST_ONLY") != "1") environment.peers = read_peers();
  if (messages::ros2_is_before_iron()) environment.gid_size = kOldGidSize;
  return environment;
}

}  // namespace bubblesim::ros2
