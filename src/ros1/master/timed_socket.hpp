// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "master/deadline.hpp"

namespace bubblesim {

/// A TCP connection whose calls end at the caller's deadline.
class TimedSocket {
 public:
  struct TimedOut : std::runtime_error {
    TimedOut() : std::runtime_error("no answer in time") {}
  };

  /// Connects. Like read() and write(), throws TimedOut, or std::runtime_error with the cause.
  TimedSocket(const std::string& host, std::uint32_t port, Deadline deadline);
  ~TimedSocket();
  TimedSocket(const TimedSocket&) = delete;
  TimedSocket& operator=(const TimedSocket&) = delete;

  void write(const void* data, std::size_t size);
  /// Reads exactly `size` bytes.
  void read(void* data, std::size_t size);

 private:
  void wait_for(short event);

  const Deadline deadline_;
  int descriptor_ = -1;
};

}  // namespace bubblesim
