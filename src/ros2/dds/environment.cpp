// SPDX-License-Identifier: BSD-3-Clause
#include "dds/environment.hpp"

#include <charconv>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

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

}  // namespace

Environment read_environment() {
  Environment environment;
  environment.domain = read_domain();
  const std::string_view distribution = variable("ROS_DISTRO");
  if (distribution == "humble" || distribution == "galactic" || distribution == "foxy") {
    environment.gid_size = kOldGidSize;
  }
  return environment;
}

}  // namespace bubblesim::ros2
