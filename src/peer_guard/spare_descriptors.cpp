// SPDX-License-Identifier: BSD-3-Clause
// Keeps some of the process's descriptors free of the connections of peers, so that files still open and each port
// still answers. Servers do not expect that there is none: libzmq then tries to accept without a pause. Each function
// at the end replaces one of the C library or of xmlrpcpp, and behaves like it while many descriptors are left.
#include <netinet/in.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <xmlrpcpp/XmlRpcServer.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>

namespace bubblesim {
namespace {

/// What a process may open, and what of it is kept.
struct DescriptorLimits {
  int all = INT_MAX;

  /// For no connection at all.
  int spare() const { return std::min(all / 3, 128); }
  /// Another as many are for ports that have fewer connections than this.
  int share() const { return all / 4; }
};

DescriptorLimits descriptor_limits() {
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur > INT_MAX) return {};
  return {static_cast<int>(limit.rlim_cur)};
}

/// The local TCP port of a socket, 0 for another one. An accepted connection has that of its server.
std::uint16_t local_port(int descriptor) {
  sockaddr_storage address{};
  socklen_t length = sizeof(address);
  if (getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &length) != 0) return 0;
  std::uint16_t port = 0;  // at the same place for both versions of IP
  if (address.ss_family == AF_INET || address.ss_family == AF_INET6) {
    std::memcpy(&port, reinterpret_cast<const char*>(&address) + offsetof(sockaddr_in, sin_port), sizeof(port));
  }
  return port;
}

bool has_its_share(int listening, int last, int share) {
  const std::uint16_t port = local_port(listening);
  int connections = -1;  // without the listening socket
  for (int descriptor = 0; port != 0 && descriptor <= last && connections < share; ++descriptor) {
    if (local_port(descriptor) == port) ++connections;
  }
  return connections >= share;
}

void warn_once(const DescriptorLimits& limits) {
  static std::atomic_flag warned = ATOMIC_FLAG_INIT;
  if (warned.test_and_set()) return;
  std::fprintf(stderr,
               "warning: this process may have %d files and connections open, and few are left: new connections are "
               "closed until others end; 'ulimit -n' before the start sets how many\n",
               limits.all);
}

/// A new descriptor is the lowest that is free, so a high one is among the last. To the server it looks as if the peer
/// had gone already, which servers expect.
int accept_unless_last(int listening, sockaddr* address, socklen_t* length, int flags) {
  const auto accepted = static_cast<int>(syscall(SYS_accept4, listening, address, length, flags));
  const DescriptorLimits limits = descriptor_limits();
  const int left = limits.all - accepted;
  if (left > 2 * limits.spare()) return accepted;
  if (left > limits.spare() && !has_its_share(listening, accepted, limits.share())) return accepted;
  close(accepted);
  warn_once(limits);
  errno = ECONNABORTED;
  return -1;
}

}  // namespace
}  // namespace bubblesim

extern "C" int accept(int listening, sockaddr* address, socklen_t* length) {
  return bubblesim::accept_unless_last(listening, address, length, 0);
}

extern "C" int accept4(int listening, sockaddr* address, socklen_t* length, int flags) {
  return bubblesim::accept_unless_last(listening, address, length, flags);
}

/// The original asks the kernel for each descriptor that the process may open, at each connection: a million in some
/// containers. accept() has kept enough of them.
bool XmlRpc::XmlRpcServer::enoughFreeFDs() { return true; }
