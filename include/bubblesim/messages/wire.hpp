// SPDX-License-Identifier: BSD-3-Clause
// Buffers for writing (WireBuffer) and reading (WireView) ROS wire bytes. Little-endian, unaligned
// (http://wiki.ros.org/msg); the code requires a little-endian machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <type_traits>

namespace bubblesim::messages {

/// A growing byte buffer. It keeps `kPrefix` bytes free in front for the length field of TCPROS, so the bridge can pass
/// the storage to roscpp without copying.
class WireBuffer {
 public:
  static constexpr std::size_t kPrefix = 4;

  WireBuffer() = default;
  WireBuffer(WireBuffer&& other) noexcept;
  WireBuffer& operator=(WireBuffer&& other) noexcept;
  WireBuffer(const WireBuffer&) = delete;
  WireBuffer& operator=(const WireBuffer&) = delete;
  ~WireBuffer() = default;

  template <class T>
  void put(T value) {
    static_assert(std::is_arithmetic_v<T>);
    std::memcpy(extend(sizeof(T)), &value, sizeof(T));
  }
  void put_bytes(const void* data, std::size_t size) {
    if (size != 0) std::memcpy(extend(size), data, size);
  }
  /// Appends `size` bytes and returns their address; valid until the next call.
  std::uint8_t* extend(std::size_t size) {
    if (size_ + size > capacity_) grow(size);
    std::uint8_t* place = storage_.get() + size_;
    size_ += size;
    return place;
  }

  /// The message without the prefix.
  const std::uint8_t* data() const { return storage_ ? storage_.get() + kPrefix : nullptr; }
  std::size_t size() const { return storage_ ? size_ - kPrefix : 0; }
  /// Clears the content, keeps the storage.
  void clear() { size_ = kPrefix; }
  /// Returns the storage (prefix first, then size() bytes) and leaves the buffer empty.
  std::unique_ptr<std::uint8_t[]> release();

 private:
  void grow(std::size_t extra);

  std::unique_ptr<std::uint8_t[]> storage_;
  std::size_t size_ = kPrefix;  // used bytes, including the prefix
  std::size_t capacity_ = 0;
};

/// A message is shorter or longer than its fields.
struct WireError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Reads bytes that it does not own; throws WireError at their end.
class WireView {
 public:
  WireView(const std::uint8_t* data, std::size_t size) : at_(data), end_(data + size) {}

  template <class T>
  T get() {
    static_assert(std::is_arithmetic_v<T>);
    T value;
    std::memcpy(&value, take(sizeof(T)), sizeof(T));
    return value;
  }
  /// The next `size` bytes; valid as long as the message is.
  const std::uint8_t* take(std::size_t size) {
    if (size > left()) throw_truncated(size);
    const std::uint8_t* place = at_;
    at_ += size;
    return place;
  }
  std::size_t left() const { return static_cast<std::size_t>(end_ - at_); }

 private:
  [[noreturn]] void throw_truncated(std::size_t wanted) const;

  const std::uint8_t* at_;
  const std::uint8_t* end_;
};

}  // namespace bubblesim::messages
