// SPDX-License-Identifier: BSD-3-Clause
#include "master/interrupt.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <ros/master.h>
#include <sys/socket.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <system_error>
#include <vector>

namespace bubblesim {
namespace {

std::vector<int> open_descriptors() {
  std::vector<int> descriptors;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd", ignored)) {
    descriptors.push_back(std::atoi(entry.path().filename().c_str()));
  }
  return descriptors;
}

/// Port of the other end; empty if the descriptor is not a connected IP socket.
std::optional<std::uint32_t> peer_port(int descriptor) {
  sockaddr_storage address{};
  socklen_t length = sizeof(address);
  if (getpeername(descriptor, reinterpret_cast<sockaddr*>(&address), &length) != 0) return std::nullopt;
  if (address.ss_family == AF_INET) return ntohs(reinterpret_cast<const sockaddr_in&>(address).sin_port);
  if (address.ss_family == AF_INET6) return ntohs(reinterpret_cast<const sockaddr_in6&>(address).sin6_port);
  return std::nullopt;
}

bool is_connecting(int descriptor) {
  tcp_info info{};
  socklen_t length = sizeof(info);
  return getsockopt(descriptor, IPPROTO_TCP, TCP_INFO, &info, &length) == 0 && info.tcpi_state == TCP_SYN_SENT;
}

}  // namespace

void interrupt_master_calls() {
  for (const int descriptor : open_descriptors()) {
    if (peer_port(descriptor) == ros::master::getPort() || is_connecting(descriptor)) shutdown(descriptor, SHUT_RDWR);
  }
}

}  // namespace bubblesim
