// SPDX-License-Identifier: BSD-3-Clause
#include "master/timed_socket.hpp"

#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <memory>
#include <system_error>
#include <utility>

namespace bubblesim {
namespace {

std::runtime_error failure(int error) { return std::runtime_error(std::generic_category().message(error)); }

using Addresses = std::unique_ptr<addrinfo, decltype(&freeaddrinfo)>;

Addresses look_up(const std::string& host, std::uint32_t port) {
  addrinfo hints{};
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const int error = getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &found);
  if (error != 0) throw std::runtime_error("unknown host '" + host + "': " + gai_strerror(error));
  return {found, &freeaddrinfo};
}

}  // namespace

TimedSocket::TimedSocket(const std::string& host, std::uint32_t port, Deadline deadline)
    : deadline_(std::move(deadline)) {
  const Addresses addresses = look_up(host, port);
  int error = ENOTCONN;
  // `localhost` may have two addresses, and the server listens on one of them.
  for (const addrinfo* address = addresses.get(); address != nullptr; address = address->ai_next) {
    descriptor_ = socket(address->ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (descriptor_ < 0) throw failure(errno);
    error = connect(descriptor_, address->ai_addr, address->ai_addrlen) == 0 ? 0 : errno;
    try {
      if (error == EINPROGRESS) {
        wait_for(POLLOUT);
        socklen_t length = sizeof(error);
        getsockopt(descriptor_, SOL_SOCKET, SO_ERROR, &error, &length);
      }
    } catch (...) {
      close(descriptor_);
      throw;
    }
    if (error == 0) {
      const int on = 1;
      setsockopt(descriptor_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on));
      return;
    }
    close(descriptor_);
  }
  throw failure(error);
}

TimedSocket::~TimedSocket() { close(descriptor_); }

void TimedSocket::wait_for(short event) {
  for (;;) {
    if (deadline_.over()) throw TimedOut();
    pollfd waiting{descriptor_, event, 0};
    const int ready = poll(&waiting, 1, static_cast<int>(deadline_.slice().count()));
    if (ready > 0) return;
    if (ready < 0 && errno != EINTR) throw failure(errno);
  }
}

void TimedSocket::write(const void* data, std::size_t size) {
  const auto* at = static_cast<const std::uint8_t*>(data);
  while (size > 0) {
    const ssize_t sent = send(descriptor_, at, size, MSG_NOSIGNAL);
    if (sent >= 0) {
      at += sent;
      size -= static_cast<std::size_t>(sent);
    } else if (errno == EAGAIN || errno == EINTR) {
      wait_for(POLLOUT);
    } else {
      throw failure(errno);
    }
  }
}

void TimedSocket::read(void* data, std::size_t size) {
  auto* at = static_cast<std::uint8_t*>(data);
  while (size > 0) {
    const ssize_t got = recv(descriptor_, at, size, 0);
    if (got > 0) {
      at += got;
      size -= static_cast<std::size_t>(got);
    } else if (got == 0) {
      throw std::runtime_error("the server closed the connection");
    } else if (errno == EAGAIN || errno == EINTR) {
      wait_for(POLLIN);
    } else {
      throw failure(errno);
    }
  }
}

}  // namespace bubblesim
