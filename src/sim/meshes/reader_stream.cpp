// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/reader_stream.hpp"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>

namespace bubblesim {

void ReaderStream::send_bytes(const void* bytes, std::size_t size) {
  const char* next = static_cast<const char*>(bytes);
  while (size > 0) {
    const ssize_t sent = ::send(socket_, next, size, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) throw StreamClosed("the socket is closed");
    next += sent;
    size -= static_cast<std::size_t>(sent);
  }
}

void ReaderStream::receive_bytes(void* bytes, std::size_t size) {
  char* next = static_cast<char*>(bytes);
  while (size > 0) {
    wait_for_input();
    const ssize_t received = ::recv(socket_, next, size, 0);
    if (received < 0 && errno == EINTR) continue;
    if (received <= 0) throw StreamClosed("the socket is closed");
    next += received;
    size -= static_cast<std::size_t>(received);
  }
}

void ReaderStream::wait_for_input() const {
  while (deadline_) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(*deadline_ - Clock::now()).count();
    pollfd waiting{socket_, POLLIN, 0};
    const int ready = ::poll(&waiting, 1, static_cast<int>(std::max<std::int64_t>(left, 0)));
    if (ready > 0) return;
    if (ready == 0) throw StreamTimeout("timeout of the socket");
    if (errno != EINTR) throw StreamClosed("the socket cannot be read");
  }
}

}  // namespace bubblesim
