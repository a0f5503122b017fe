// SPDX-License-Identifier: BSD-3-Clause
#include "advertised_address.hpp"

#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/in.h>
#include <ros/network.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

namespace bubblesim {
namespace {

thread_local AdvertisedAddress* advertised = nullptr;

int bind_as_asked(int descriptor, const sockaddr* address, socklen_t length) {
  return static_cast<int>(syscall(SYS_bind, descriptor, address, length));
}

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

/// The host that roscpp advertises if the user chose it, otherwise empty: the default is the machine's name.
std::string chosen_host() {
  std::array<char, HOST_NAME_MAX + 1> machine{};
  gethostname(machine.data(), machine.size() - 1);
  const std::string& host = ros::network::getHost();
  return is_set("ROS_HOSTNAME") || is_set("ROS_IP") || host != machine.data() ? host : std::string();
}

union Address {
  sockaddr any;
  sockaddr_in ip4;
  sockaddr_in6 ip6;
};

bool is_wildcard(const sockaddr* address) {
  Address read{};
  if (address->sa_family == AF_INET) {
    std::memcpy(&read.ip4, address, sizeof(read.ip4));
    return read.ip4.sin_addr.s_addr == htonl(INADDR_ANY);
  }
  if (address->sa_family != AF_INET6) return false;
  std::memcpy(&read.ip6, address, sizeof(read.ip6));
  return IN6_IS_ADDR_UNSPECIFIED(&read.ip6.sin6_addr);
}

bool is_loopback(const Address& address) {
  constexpr std::uint32_t kNetwork = 127;
  if (address.any.sa_family == AF_INET) return ntohl(address.ip4.sin_addr.s_addr) >> 24 == kNetwork;
  return IN6_IS_ADDR_LOOPBACK(&address.ip6.sin6_addr);
}

/// Whether other machines also resolve it to a loopback address.
bool means_loopback(const std::string& host) {
  constexpr std::string_view kDomain = ".localhost";
  const bool in_domain =
      host.size() > kDomain.size() && host.compare(host.size() - kDomain.size(), kDomain.size(), kDomain) == 0;
  in6_addr literal{};
  return host == "localhost" || in_domain || inet_pton(AF_INET, host.c_str(), &literal) == 1 ||
         inet_pton(AF_INET6, host.c_str(), &literal) == 1;
}

/// The address of a host that has exactly one.
std::optional<Address> only_address(const std::string& host, int family) {
  addrinfo hints{};
  hints.ai_family = family;
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (getaddrinfo(host.c_str(), nullptr, &hints, &found) != 0) return std::nullopt;
  const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> addresses(found, &freeaddrinfo);
  if (found->ai_next != nullptr || found->ai_addrlen > sizeof(Address)) return std::nullopt;
  Address address{};
  std::memcpy(&address, found->ai_addr, found->ai_addrlen);
  return address;
}

}  // namespace

void stay_on_this_machine(int argc, const char* const* argv) {
  const char* of_environment = std::getenv("ROS_MASTER_URI");
  std::string master = of_environment != nullptr ? of_environment : "http://localhost:11311";
  bool is_chosen = is_set("ROS_HOSTNAME") || is_set("ROS_IP");
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    const std::string name = argument.substr(0, argument.find(":="));
    if (name == "__master") master = argument.substr(name.size() + 2);
    is_chosen = is_chosen || name == "__hostname" || name == "__ip";
  }
  std::string host;
  std::uint32_t port = 0;
  if (is_chosen || !ros::network::splitURI(master, host, port)) return;
  if (host == "localhost" || host.rfind("127.", 0) == 0) setenv("ROS_HOSTNAME", "localhost", 1);
}

AdvertisedAddress::AdvertisedAddress() : host_(chosen_host()) { advertised = this; }

AdvertisedAddress::~AdvertisedAddress() { advertised = nullptr; }

bool AdvertisedAddress::bind_instead(int descriptor, const sockaddr* wildcard) {
  if (host_.empty() || !is_wildcard(wildcard)) return false;
  std::optional<Address> address = only_address(host_, wildcard->sa_family);
  if (!address || (is_loopback(*address) && !means_loopback(host_))) return false;
  Address asked{};
  std::memcpy(&asked, wildcard, wildcard->sa_family == AF_INET ? sizeof(asked.ip4) : sizeof(asked.ip6));
  socklen_t length = sizeof(address->ip4);
  if (wildcard->sa_family == AF_INET) {
    address->ip4.sin_port = asked.ip4.sin_port;
  } else {
    address->ip6.sin6_port = asked.ip6.sin6_port;
    length = sizeof(address->ip6);
  }
  if (bind_as_asked(descriptor, &address->any, length) == 0) return true;
  if (errno == EADDRNOTAVAIL && !std::exchange(warned_, true)) {
    std::fprintf(stderr,
                 "warning: this node advertises itself as '%s' (ROS_HOSTNAME, ROS_IP), which is not an address of this "
                 "machine: listening on all addresses\n",
                 host_.c_str());
  }
  return false;
}

}  // namespace bubblesim

/// Replaces the C library's bind(), and behaves like it except within an AdvertisedAddress. roscpp has no setting for
/// the address: its XML-RPC server always binds to all addresses.
extern "C" int bind(int descriptor, const sockaddr* address, socklen_t length) noexcept {
  bubblesim::AdvertisedAddress* instead = bubblesim::advertised;
  if (instead != nullptr && address != nullptr && instead->bind_instead(descriptor, address)) return 0;
  return bubblesim::bind_as_asked(descriptor, address, length);
}
