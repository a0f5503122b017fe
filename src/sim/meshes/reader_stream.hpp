// SPDX-License-Identifier: BSD-3-Clause
// Values and arrays over a stream socket, between processes of one machine.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace bubblesim {

/// The socket was closed, or received an unexpected value.
struct StreamClosed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The other process did not send in time.
struct StreamTimeout : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class ReaderStream {
 public:
  using Clock = std::chrono::steady_clock;

  /// The caller keeps ownership of the socket.
  explicit ReaderStream(int socket) : socket_(socket) {}

  /// Time limit for receiving; empty: none.
  void set_deadline(std::optional<Clock::time_point> deadline) { deadline_ = deadline; }

  template <class T>
  void send(const T& value) {
    if constexpr (std::is_trivially_copyable_v<T>) {
      send_bytes(&value, sizeof value);
    } else {
      static_assert(std::is_trivially_copyable_v<typename T::value_type>);
      send(static_cast<std::uint64_t>(value.size()));
      send_bytes(value.data(), value.size() * sizeof(typename T::value_type));
    }
  }

  template <class T>
  void receive(T& value) {
    if constexpr (std::is_trivially_copyable_v<T>) {
      receive_bytes(&value, sizeof value);
    } else {
      static_assert(std::is_trivially_copyable_v<typename T::value_type>);
      std::uint64_t size = 0;
      receive(size);
      if (size > kMostBytes / sizeof(typename T::value_type)) throw StreamClosed("an array is too long");
      value.resize(size);
      receive_bytes(value.data(), size * sizeof(typename T::value_type));
    }
  }

 private:
  static constexpr std::uint64_t kMostBytes = 1ULL << 30U;  // of an array

  void send_bytes(const void* bytes, std::size_t size);
  void receive_bytes(void* bytes, std::size_t size);
  void wait_for_input() const;

  int socket_;
  std::optional<Clock::time_point> deadline_;
};

}  // namespace bubblesim
